// Carries out one Intent at a time. It only switches: each intent has its maneuver (autonomy/maneuvers), made when the
// intent begins and destroyed when it ends. A retreat of the reactive layer overrides the intent.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/maneuvers/executor_config.hpp"
#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/maneuvers/maneuver.hpp"
#include "autonomy/maneuvers/retreat_flight.hpp"
#include "autonomy/planning_jobs/planning_desk.hpp"
#include "common/event_log.hpp"
#include "common/intent.hpp"
#include "common/jobs.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// One thread. tick() at the behaviours' rate; react() at the laser rate. Outlives the jobs it submits.
class Executor {
 public:
  /// `camera` is its data sheet, which outlives the executor, or null without one.
  Executor(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
           control::FlightController& controller, common::JobRunner& jobs, common::EventLog& log,
           const common::RgbdCameraConfig* camera = nullptr);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  ~Executor();

  /// Carries out the intent. An intent with the id of the last one continues its maneuver.
  void tick(const common::Intent& intent, const ManeuverInput& input);
  /// Flies the retreat of the reactive layer, or, without one, returns the vehicle to the intent.
  void react(const planning::AvoidanceDecision& decision, const common::VehicleState& state);
  /// No sensor sees the surroundings any more: a retreat ends in a hold.
  void endRetreat() { retreat_.end(); }

  const common::IntentStatus& status() const { return status_; }
  /// What the maneuver is after now; nothing once the intent has ended.
  Aim aim() const { return maneuver_ ? maneuver_->aim(state_) : Aim{}; }
  std::vector<Eigen::Vector2d> remainingPlan_map_m() const;
  /// From where the vehicle can stop to the place near it that is farthest from the walls; zero without a map. See
  /// FlightController::setEscape.
  Eigen::Vector2d escape_map_m(const common::VehicleState& state) const;
  /// How much lower than its paths' height the vehicle flies, on a path in space; negative above, else 0.
  double dip_m() const { return autonomy::dip_m(memory_, controller_); }
  /// The newest cost map of the height at which the vehicle is; null before the first.
  std::shared_ptr<const planning::CostMap> costMapHere() const {
    return desk_.costMapAt(heightsOf(memory_, controller_));
  }
  /// The state of the planning.
  const PlanningDesk& desk() const { return desk_; }

 private:
  void begin(const common::Intent& intent);
  void note(const Progress& progress);
  void receive(const PlanningAnswer& answer, common::Time now);
  PlanningClient client() const;

  ExecutorConfig config_;
  const common::RgbdCameraConfig* camera_;
  control::FlightController& controller_;
  PlanningDesk desk_;
  RetreatFlight retreat_;
  FlightMemory memory_;

  common::Intent intent_;
  common::IntentStatus status_;
  std::unique_ptr<Maneuver> maneuver_;  ///< The maneuver of the intent; null if the intent has ended.
  common::Time now_;
  common::VehicleState state_;  ///< The newest state.
  common::PlaceNames names_;    ///< Of the newest tick.
};

}  // namespace swiftlet::autonomy
