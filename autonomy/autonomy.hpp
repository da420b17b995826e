// The whole autonomy: takes one stamped input at a time and returns setpoints. A tick is three values, as in the flow
// of docs/architecture.md:
//
//   sense(Input) -> Percept      decide(Percept) -> Intent      fly(Intent, Percept) -> Setpoint
//     ^                                                           |
//     +------------------------- Feedback ------------------------+
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/autonomy_config.hpp"
#include "autonomy/commander.hpp"
#include "autonomy/input.hpp"
#include "autonomy/navigator.hpp"
#include "autonomy/senses.hpp"
#include "autonomy/vehicle_memory.hpp"
#include "autonomy/world_builder.hpp"
#include "common/command.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/vehicle.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// What the parts have counted so far.
struct AutonomyCounts {
  std::uint64_t late_scans = 0;  ///< Came after a later one had been used, and were left out.
  EstimatorCounts estimator;
  PlanningUse planning;  ///< The planner and the explorer in use, with the number of their results.
};

/// One thread. The outputs depend only on the inputs and their order. The time of an input is never before that of the
/// previous one.
class Autonomy {
 public:
  explicit Autonomy(AutonomySetup setup);
  ~Autonomy();

  /// The mission begins when the operator starts it, or another one. Call it before the first input.
  void waitForStart() { commander_.waitForStart(); }
  /// The maps that the first mission may load; every other one brings its own. Call it before the first input.
  void offerMaps(std::vector<OfferedMap> maps) { commander_.offerMaps(std::move(maps)); }

  /// Returns a setpoint for a tick, and nothing for any other input. The delivered job must be outstanding
  /// (jobs().awaits).
  std::optional<common::Setpoint> process(const Input& input);

  /// The runner of its jobs. Before each input of a time, process what jobs().nextDue(time) returns.
  const common::JobRunner& jobs() const { return *jobs_; }

  /// The newest snapshot; never null.
  std::shared_ptr<const common::World> world() const { return world_; }
  /// True when the mission has ended and the vehicle stands with its motors off.
  bool finished() const;
  const std::string& vehicleName() const { return vehicle_name_; }
  const common::MissionStatus& missionStatus() const { return commander_.missionStatus(); }
  /// True if the mission ended by the operator's land command.
  bool landedByOperator() const { return commander_.landedByOperator(); }
  common::VehicleState state() const { return senses_.estimator().state(); }
  /// The reference of the controller; nullopt unless the vehicle flies.
  std::optional<Eigen::Vector3d> reference_odom_m() const { return navigator_.reference_odom_m(); }
  /// Height over the take-off floor of the slice of the map that is shown.
  double mapHeight_m() const { return navigator_.mapHeight_m(); }
  /// What is known of the vehicle now: what it was given, and what the flight has learned.
  VehicleMemory learned() const;
  AutonomyCounts counts() const;
  /// The intent since the last tick of the behaviours, and its status.
  const common::Intent& intent() const { return commander_.decision().intent; }
  const common::IntentStatus& intentStatus() const { return navigator_.executor().status(); }

  /// The events since the last call, by their stamps.
  std::vector<common::Event> takeEvents();
  std::vector<common::CommandResult> takeResults() { return commander_.takeResults(); }
  /// The files that the mission requested since the last call.
  std::vector<RunFile> takeFiles() { return commander_.takeFiles(); }
  /// See Estimator::setFilterListener.
  void setFilterListener(perception::FilterListener* listener) { senses_.setFilterListener(listener); }

 private:
  void take(const common::SensorEvent& event);
  common::Setpoint tick(common::Time now);
  std::shared_ptr<const common::World> snapshot(const Percept& percept);

  std::string vehicle_name_;  ///< Also identifies the data sheet, for what is learned.
  std::string vehicle_kind_;
  common::EventLog log_;
  // The results of jobs refer to these members. jobs_ follows them, so that it is destroyed first.
  Senses senses_;
  Commander commander_;
  Navigator navigator_;
  std::unique_ptr<common::JobRunner> jobs_;

  bool heard_ = true;  ///< The senses have heard the feedback of the last tick.
  WorldBuilder world_builder_;
  std::shared_ptr<const common::World> world_;
};

}  // namespace swiftlet::autonomy
