// Flies the plans of one maneuver: requests them, keeps a plan while it is good, offers it to the flight controller,
// and reports arrival at a goal.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "autonomy/maneuvers/maneuver.hpp"
#include "common/flight_mode.hpp"
#include "common/hysteresis.hpp"
#include "planning/search/plan_keeper.hpp"
#include "planning/search/yaw_planner.hpp"

namespace swiftlet::autonomy {

/// A velocity of this size from the first point of a path towards what follows; zero without a path.
Eigen::Vector2d velocityAlong(std::span<const Eigen::Vector2d> points, double speed_m_s);

/// What the vehicle sees with, for the yaw along its paths.
planning::ViewAhead viewOf(const ManeuverSetup& setup);
/// Plans the yaw along the path, from that of the reference on.
void face(control::FlightPath& path, const planning::YawPlanner& planner, const control::FlightController& controller,
          const common::VehicleState& state);

/// One thread. A plan lasts as long as the controller follows it: a retreat, a lost estimate or the pilot ends it.
class PathFlight {
 public:
  PathFlight(const ManeuverSetup& setup, common::FlightMode mode);

  bool mayAsk() const { return desk_.free(); }
  /// The person is left out of the world in which it plans; null: nobody is.
  void ask(const ManeuverInput& input, PlanningQuestion question, const perception::PersonWatch* left_out = nullptr);

  /// Call it once a tick. Stops if the plan has become invalid on the present cost map; true if a new plan is needed.
  bool keep(const ManeuverInput& input);
  /// Flies the path, unless the present plan is about as good.
  void offer(const planning::Path& path, common::Time now, const common::VehicleState& state);
  /// The next plan that is offered is flown; until then the vehicle flies on.
  void release() { keeper_.clear(); }
  /// Stops. The next plan that is offered is flown.
  void abandon();
  /// Greatest speed on the present plan; it does not apply to the next one.
  void setPace(double speed_m_s);
  /// The heading at the end of later paths; nullopt for the direction of flight.
  void setGoalYaw(std::optional<double> yaw_map_rad) { goal_yaw_map_rad_ = yaw_map_rad; }

  /// The vehicle has been at the goal and at the flight's height, within the tolerance and slow, for a while. Call it
  /// at every tick.
  bool arrived(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m, double tolerance_m);

  /// The present plan; null without one.
  const planning::Path* plan() const { return controller_.follower().followsPath() ? keeper_.plan() : nullptr; }
  /// The rest of the plan, from the place where the vehicle was last seen; empty without a plan.
  std::vector<Eigen::Vector2d> remaining_map_m() const;
  /// The flight, and the velocity along the plan at the mode's speed and the pace.
  Aim aim() const;

 private:
  /// A goal is reached only when the vehicle has been within the tolerance for this long.
  static constexpr double kArrival_s = 0.25;
  planning::PlanMaps mapsOf(const planning::CostMap& costs) const;
  std::vector<Eigen::Vector3d> liftedPoints(const planning::Path& path) const;
  common::ClearanceAlong clearanceAlong(const planning::Path& path) const;
  double endHeight_m() const;

  control::FlightController& controller_;
  PlanningDesk& desk_;
  FlightMemory& memory_;
  PlanningClient client_;
  common::FlightMode mode_;
  planning::PlanKeeper keeper_;
  planning::YawPlanner yaw_planner_;
  double pace_m_s_ = std::numeric_limits<double>::infinity();
  std::optional<double> goal_yaw_map_rad_;
  common::Hysteresis within_{kArrival_s};  ///< The tolerances of the goal.
};

}  // namespace swiftlet::autonomy
