// Carries out one Intent at a time. It only switches: each intent has its maneuver (autonomy/maneuvers), made when the
// intent begins and destroyed when it ends; a retreat of the reactive layer comes before everything the intent wants.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/executor_config.hpp"
#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/maneuvers/maneuver.hpp"
#include "autonomy/maneuvers/retreat_flight.hpp"
#include "autonomy/planning_desk.hpp"
#include "common/event.hpp"
#include "common/intent.hpp"
#include "common/jobs.hpp"
#include "common/vehicle_config.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// One thread. tick() at the behaviours' rate; react() at the laser rate. Outlives the jobs it submits.
class Executor {
 public:
  Executor(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
           control::FlightController& controller, common::JobRunner& jobs);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  ~Executor();

  /// Carries out the intent; the same id goes on with what is under way.
  void tick(const common::Intent& intent, const ManeuverInput& input);
  /// Follows the retreat of the reactive layer, or gives the vehicle back to the intent when there is none.
  void react(const planning::AvoidanceDecision& decision, const common::VehicleState& state);

  const common::IntentStatus& status() const { return status_; }
  /// Along the path being flown; zero when none is.
  Eigen::Vector2d wantedVelocity_map_m_s() const;
  std::vector<Eigen::Vector2d> remainingPlan_map_m() const;
  /// Where the vehicle flies to at present, if the intent is such.
  std::optional<Eigen::Vector2d> goal_map_m() const;
  /// What planning knows.
  const PlanningDesk& desk() const { return desk_; }

  std::vector<common::Event> takeEvents();

 private:
  void begin(const common::Intent& intent);
  void note(const Progress& progress);
  void receive(const PlanningAnswer& answer, common::Time now);
  PlanningClient client() const;

  ExecutorConfig config_;
  control::FlightController& controller_;
  PlanningDesk desk_;
  RetreatFlight retreat_;
  FlightMemory memory_;

  common::Intent intent_;
  common::IntentStatus status_;
  std::unique_ptr<Maneuver> maneuver_;  ///< Of the intent; null when that has ended.
  common::Time now_;
  common::VehicleState state_;  ///< The newest.
};

}  // namespace swiftlet::autonomy
