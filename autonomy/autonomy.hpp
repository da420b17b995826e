// The whole autonomy: takes one stamped input at a time and returns setpoints. This is the picture of
// docs/architecture.md as code.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimator.hpp"
#include "autonomy/executor.hpp"
#include "autonomy/input.hpp"
#include "autonomy/reactive.hpp"
#include "autonomy/supervisor.hpp"
#include "autonomy/world_builder.hpp"
#include "behaviors/mission.hpp"
#include "common/command.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/world.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// All settings of the autonomy; a system profile (config/systems) gives them.
struct AutonomyConfig {
  EstimatorConfig estimator;
  ReactiveConfig reactive;
  ExecutorConfig execution;
  control::FlightController::Config control;
  SupervisorConfig supervisor;
  double behavior_rate_hz = 20.0;
  double scan_latency_s = 0.004;
  double max_height_m = 10.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
  /// Lowers the fields of view and ranges that avoidance and exploration use to those of the laser.
  void limitTo(const common::LaserConfig& laser);
  /// Why the reactive layer would stop the vehicle, or make it retreat, on a path planned at this clearance; empty if
  /// it would not.
  std::vector<std::string> problemsWith(double clearance_m) const;
};

/// One thread; a function of its inputs in their order. The time of an input is never before that of the last one.
class Autonomy {
 public:
  /// `given`: a map of the place, to find itself in; none: null. Read in the constructor alone. `vehicle_name` stands
  /// in its snapshots and in the events that its loop tells; empty where there is only one vehicle.
  Autonomy(const AutonomyConfig& config, const common::VehicleConfig& vehicle, const common::LaserConfig& laser,
           behaviors::Mission mission, std::unique_ptr<common::JobRunner> jobs, const GivenMap* given = nullptr,
           std::string vehicle_name = {});
  ~Autonomy();

  /// Returns a setpoint for a tick, and nothing for any other input. The delivery of a job must be awaited.
  std::optional<common::Setpoint> process(const Input& input);

  /// The delivery of a job that is due at or before `now`, if there is one. Call it before each input of that time.
  std::optional<common::JobDelivery> dueDelivery(common::Time now) const { return jobs_->nextDue(now); }
  /// False for the delivery of a job that was never submitted or is delivered already: the inputs are then not those of
  /// a flight of this autonomy.
  bool awaits(const common::JobDelivery& delivery) const { return jobs_->awaits(delivery); }
  std::vector<common::JobTimes> jobTimes() const { return jobs_->times(); }

  /// The newest snapshot; never null.
  std::shared_ptr<const common::World> world() const { return world_; }
  /// The mission has ended and the vehicle stands with its motors off.
  bool finished() const;
  const std::string& vehicleName() const { return vehicle_name_; }
  const common::MissionStatus& missionStatus() const { return mission_status_; }
  /// The mission ended by the operator's Land.
  bool landedByOperator() const { return supervisor_.landedByOperator(); }
  common::VehicleState state() const { return estimator_.state(); }
  /// What the matcher and the SLAM method that the profile names have done.
  const perception::LaserOdometryCounts& odometryCounts() const { return estimator_.odometryCounts(); }
  const perception::SlamCounts& slamCounts() const { return estimator_.slamCounts(); }
  /// What is carried out since the last tick of the behaviours, and how it stands.
  const common::Intent& intent() const { return intent_; }
  const common::IntentStatus& intentStatus() const { return executor_.status(); }

  std::vector<common::Event> takeEvents();
  std::vector<common::CommandResult> takeResults();

 private:
  void take(const common::SensorEvent& event);
  void take(const common::OperatorCommand& command, common::Time now);
  common::Setpoint tick(common::Time now);
  void processDueScans(common::Time now);
  void processScan(const common::LaserScan& scan, common::Time now);
  void prepare();
  void tickBehaviors(common::Time now);
  common::Intent nextIntent(common::Time now);
  bool missionOver() const { return common::isOver(mission_status_.state); }
  void tickMission();
  void takeSnapshot(common::Time now);
  void collect(std::vector<common::Event> events);

  AutonomyConfig config_;
  common::VehicleConfig vehicle_;
  std::string vehicle_name_;
  // Delivered results refer to the parts below, so the jobs go first when the autonomy ends.
  Estimator estimator_;
  Reactive reactive_;
  control::FlightController controller_;
  Executor executor_;
  Supervisor supervisor_;
  behaviors::Mission mission_;
  std::unique_ptr<common::JobRunner> jobs_;

  struct WaitingScan {
    std::shared_ptr<const common::LaserScan> scan;
    common::Time due;
  };
  std::vector<WaitingScan> scans_;
  common::EnergyLayer energy_;
  std::optional<control::RawHeight> raw_height_;
  std::shared_ptr<const common::LaserPoints> laser_points_;

  behaviors::Context context_;
  common::Intent intent_;
  common::MissionStatus mission_status_;
  bool lets_go_ = false;  ///< A landing from above the mission has begun, and the mission has not let go yet.
  bool prepared_ = false;
  std::optional<common::Time> last_behaviors_;

  WorldBuilder world_builder_;
  std::shared_ptr<const common::World> world_;
  std::vector<common::Event> events_;
  std::vector<common::CommandResult> results_;
};

}  // namespace swiftlet::autonomy
