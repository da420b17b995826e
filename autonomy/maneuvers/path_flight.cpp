#include "autonomy/maneuvers/path_flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr double kArrivalSpeed_m_s = 0.15;  ///< A goal is reached only when the vehicle is slower.

}  // namespace

Eigen::Vector2d velocityAlong(std::span<const Eigen::Vector2d> points, double speed_m_s) {
  constexpr double kAhead_m = 0.05;  // A shorter step gives no reliable direction.
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d step = points[i] - points.front();
    if (step.norm() > kAhead_m) return speed_m_s * step.normalized();
  }
  return Eigen::Vector2d::Zero();
}

/// The laser's field is as wide as the explorer takes it to be: that of its sheet.
planning::ViewAhead viewOf(const ManeuverSetup& setup) {
  const auto half_rad = [](double field_deg) { return 0.5 * field_deg * common::kRadPerDeg; };
  planning::ViewAhead view;
  view.laser_half_field_rad = half_rad(setup.config.planning.explorer.laser_field_of_view_deg);
  if (setup.camera != nullptr) view.camera_half_field_rad = half_rad(setup.camera->field_of_view_deg);
  view.hull_radius_m = setup.desk.hullRadius_m();
  return view;
}

void face(control::FlightPath& path, const planning::YawPlanner& planner, const control::FlightController& controller,
          const common::VehicleState& state) {
  const control::PathFollower& follower = controller.follower();
  const control::Reference& reference = follower.reference();
  planning::YawTask task;
  task.yaw_rad = reference.yaw_odom_rad + state.T_map_odom.yaw_rad;
  task.goal_yaw_rad = path.goal_yaw_map_rad;
  task.start_speed_m_s = reference.velocity_odom_m_s.head<2>().norm();
  task.speed_m_s = follower.speed_m_s(path.mode);
  task.acceleration_m_s2 = follower.acceleration_m_s2(path.mode);
  task.yaw_rate_rad_s = follower.yawRate_rad_s();
  std::vector<Eigen::Vector2d> points_map_m;
  for (const Eigen::Vector3d& point : path.points_map_m) points_map_m.emplace_back(point.head<2>());
  path.facings_map = planner.plan(points_map_m, task);
}

PathFlight::PathFlight(const ManeuverSetup& setup, common::FlightMode mode)
    : controller_(setup.controller),
      desk_(setup.desk),
      memory_(setup.memory),
      client_(setup.client),
      mode_(mode),
      yaw_planner_(viewOf(setup)) {}

void PathFlight::ask(const ManeuverInput& input, PlanningQuestion question, const perception::PersonWatch* left_out) {
  if (auto* goal = std::get_if<GoalRequest>(&question)) goal->height = heightsOf(memory_, controller_);
  desk_.ask(planningRequest(input, client_, std::move(question), left_out), input.now);
}

bool PathFlight::keep(const ManeuverInput& input) {
  const auto cost_map = desk_.costMap();
  if (!cost_map || !plan()) return true;
  const auto check =
      keeper_.check(input.now, mapsOf(*cost_map), input.position_map_m(),
                    controller_.follower().brakingDistance_m(mode_, input.state.velocity_odom_m_s.head<2>().norm()));
  if (!check.valid) {
    memory_.log.info(input.now, kFlightSource, "plan discarded", check.reason);
    abandon();
  }
  return check.replan;
}

void PathFlight::offer(const planning::Path& path, common::Time now, const common::VehicleState& state) {
  const auto cost_map = desk_.costMap();
  if (!cost_map) return;
  if (!plan()) keeper_.clear();  // A plan that is no longer followed is dropped.
  const bool had = plan() != nullptr && plan()->points_map_m.back() == path.points_map_m.back();
  const double before_m = common::polylineLength(remaining_map_m());
  if (!keeper_.offer(path, now, mapsOf(*cost_map), state.T_map_body_planar().position_m())) return;
  if (had)
    memory_.log.info(now, kFlightSource, "plan replaced",
                     fmt::format("{:.1f} m to go instead of {:.1f} m", path.length_m, before_m));
  if (path.isInSpace()) {
    if (!memory_.in_space) {
      const auto [lowest, highest] = std::minmax_element(path.heights_m.begin(), path.heights_m.end());
      memory_.log.info(now, kFlightSource, fmt::format("changes its height, {:.2f} to {:.2f} m", *lowest, *highest),
                       fmt::format("obstacle on the path at {:.2f} m", memory_.cruise_height_m));
    }
    memory_.in_space = true;
  }
  control::FlightPath flown;
  flown.points_map_m = liftedPoints(path);
  flown.mode = mode_;
  flown.goal_yaw_map_rad = goal_yaw_map_rad_;
  flown.clearance_m = clearanceAlong(path);
  face(flown, yaw_planner_, controller_, state);
  (void)controller_.follow(flown);
  pace_m_s_ = std::numeric_limits<double>::infinity();
}

planning::PlanMaps PathFlight::mapsOf(const planning::CostMap& costs) const {
  const auto space = desk_.space();
  return {costs, space ? &space->hull : nullptr};
}

/// The points with their heights; where the height changes on the spot, the same place twice. A vehicle that is not at
/// the height of a path of one height changes it before it moves on. Where such a path begins where the hull does not
/// fit at that height (below a beam), it leaves that place at the height at which the vehicle is.
std::vector<Eigen::Vector3d> PathFlight::liftedPoints(const planning::Path& path) const {
  const auto& points = path.points_map_m;
  const FlightHeights heights = heightsOf(memory_, controller_);
  const auto heightOf = [&](std::size_t line) {
    return heights.isOff() && line < path.escape_points ? heights.reference_m : memory_.cruise_height_m;
  };
  std::vector<Eigen::Vector3d> lifted;
  const auto add = [&](std::size_t i, double height_m) { lifted.emplace_back(points[i].x(), points[i].y(), height_m); };
  if (path.isInSpace()) {
    for (std::size_t i = 0; i < points.size(); ++i) add(i, path.heights_m[i]);
    return lifted;
  }
  if (memory_.in_space) add(0, heights.reference_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = i + 1 < points.size() ? i : before;
    add(i, heightOf(before));
    if (heightOf(after) != heightOf(before)) add(i, heightOf(after));
  }
  return lifted;
}

/// Enough is what a flown path keeps and a gap leaves: the hull with half of its clearance.
common::ClearanceAlong PathFlight::clearanceAlong(const planning::Path& path) const {
  const auto space = desk_.space();
  if (path.isInSpace() && space)
    return [space](const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m) {
      const planning::HullSpace& hull = space->hull;
      return std::min(hull.clearance.along_m(hull.middleOf(from_map_m), hull.middleOf(to_map_m)), hull.radius_m);
    };
  return [costs = desk_.costMap()](const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m) {
    const planning::Footprint& hull = costs->footprint();
    return std::min(costs->clearance().along_m(from_map_m, to_map_m), hull.hull_radius_m + 0.5 * hull.clearance_m);
  };
}

void PathFlight::setPace(double speed_m_s) {
  pace_m_s_ = std::max(0.0, speed_m_s);
  controller_.setPace(pace_m_s_);
}

void PathFlight::abandon() {
  controller_.hold();
  keeper_.clear();
}

bool PathFlight::arrived(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m, double tolerance_m) {
  const Eigen::Vector3d position_map_m = input.state.T_map_body().position_m;
  const bool within =
      (position_map_m.head<2>() - goal_map_m).norm() < tolerance_m &&
      std::abs(position_map_m.z() - endHeight_m() - controller_.lift_m()) < std::max(0.10, tolerance_m) &&
      input.state.velocity_odom_m_s.norm() < kArrivalSpeed_m_s;
  within_.update(within, input.now);
  return within_.active();
}

/// A plan whose goal is free only at another height ends there. The height of paths may be above the greatest: the
/// mission that replaced another may allow less.
double PathFlight::endHeight_m() const {
  const planning::Path* flown = plan();
  const double height_m = flown != nullptr && flown->isInSpace() ? flown->heights_m.back() : memory_.cruise_height_m;
  return std::min(height_m, controller_.maxHeight_m());
}

std::vector<Eigen::Vector2d> PathFlight::remaining_map_m() const {
  return plan() ? keeper_.remaining() : std::vector<Eigen::Vector2d>{};
}

Aim PathFlight::aim() const {
  Aim aim;
  aim.flight = this;
  aim.velocity_map_m_s = velocityAlong(remaining_map_m(), std::min(pace_m_s_, controller_.follower().speed_m_s(mode_)));
  return aim;
}

}  // namespace swiftlet::autonomy
