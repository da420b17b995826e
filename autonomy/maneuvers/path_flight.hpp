// Flies the plans of one maneuver: asks for them, keeps a plan while it is good, offers it to the flight controller,
// and tells when a goal is reached.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "autonomy/maneuvers/maneuver.hpp"
#include "common/flight_mode.hpp"
#include "planning/search/plan_keeper.hpp"

namespace swiftlet::autonomy {

/// One thread. A plan lasts as long as the controller follows it: a retreat, a lost estimate or the pilot ends it.
class PathFlight {
 public:
  PathFlight(const ManeuverSetup& setup, common::FlightMode mode);

  bool mayAsk() const { return desk_.free(); }
  void ask(const ManeuverInput& input, PlanningQuestion question) { desk_.ask(input, client_, std::move(question)); }

  /// Once a tick. Stops when the plan has become invalid on the present cost map; true when a new plan is wanted.
  bool keep(const ManeuverInput& input);
  /// Flies the path, unless the plan under way leads there about as well.
  void offer(const planning::Path& path, common::Time now, const common::VehicleState& state);
  /// Whatever is offered next is flown; until then the vehicle goes on.
  void release() { keeper_.clear(); }
  /// Stops. Whatever is offered next is flown.
  void abandon();
  /// The heading at the end of the paths offered from now on; none: that of the flight.
  void setGoalYaw(std::optional<double> yaw_map_rad) { goal_yaw_map_rad_ = yaw_map_rad; }

  /// At the goal and at the flight's height within the tolerance, and slow, for a while. To be asked at every tick.
  bool arrived(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m, double tolerance_m);

  /// Null without one.
  const planning::Path* plan() const { return controller_.followsPath() ? keeper_.plan() : nullptr; }
  /// What is left of the plan, from where the vehicle was seen last; empty without one.
  std::vector<Eigen::Vector2d> remaining_map_m() const;
  /// Along the plan at the mode's speed; zero without one.
  Eigen::Vector2d wantedVelocity_map_m_s() const;

 private:
  const ExecutorConfig& config_;
  control::FlightController& controller_;
  PlanningDesk& desk_;
  FlightMemory& memory_;
  PlanningClient client_;
  common::FlightMode mode_;
  planning::PlanKeeper keeper_;
  std::optional<double> goal_yaw_map_rad_;
  std::optional<common::Time> within_since_;  ///< The goal's tolerances are met.
};

}  // namespace swiftlet::autonomy
