#include "autonomy/maneuvers/path_flight.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {

Eigen::Vector2d velocityAlong(std::span<const Eigen::Vector2d> points, double speed_m_s) {
  constexpr double kAhead_m = 0.05;  // A shorter step gives no reliable direction.
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d step = points[i] - points.front();
    if (step.norm() > kAhead_m) return speed_m_s * step.normalized();
  }
  return Eigen::Vector2d::Zero();
}

PathFlight::PathFlight(const ManeuverSetup& setup, common::FlightMode mode)
    : config_(setup.config),
      controller_(setup.controller),
      desk_(setup.desk),
      memory_(setup.memory),
      client_(setup.client),
      mode_(mode),
      keeper_(setup.config.plan_keeper) {}

bool PathFlight::keep(const ManeuverInput& input) {
  const auto cost_map = desk_.costMap();
  if (!cost_map || !plan()) return true;
  const auto check =
      keeper_.check(input.now, *cost_map, input.position_map_m(),
                    controller_.brakingDistance_m(mode_, input.state.velocity_odom_m_s.head<2>().norm()));
  if (!check.valid) {
    memory_.say(input.now, common::Severity::kInfo, "plan given up", check.reason);
    abandon();
  }
  return check.replan;
}

void PathFlight::offer(const planning::Path& path, common::Time now, const common::VehicleState& state) {
  const auto cost_map = desk_.costMap();
  if (!cost_map) return;
  if (!plan()) keeper_.clear();  // A plan that is no longer followed is dropped.
  if (!keeper_.offer(path, now, *cost_map, state.T_map_body_planar().position_m())) return;
  control::FlightPath flown;
  for (const Eigen::Vector2d& point : path.points_map_m)
    flown.points_map_m.emplace_back(point.x(), point.y(), memory_.cruise_height_m);
  flown.mode = mode_;
  flown.goal_yaw_map_rad = goal_yaw_map_rad_;
  (void)controller_.follow(flown);
  pace_m_s_ = std::numeric_limits<double>::infinity();
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
      std::abs(position_map_m.z() - memory_.cruise_height_m - controller_.lift_m()) < std::max(0.10, tolerance_m) &&
      input.state.velocity_odom_m_s.norm() < config_.arrival_speed_m_s;
  if (!within) {
    within_since_.reset();
    return false;
  }
  if (!within_since_) within_since_ = input.now;
  return (input.now - *within_since_).seconds() >= config_.arrival_s;
}

std::vector<Eigen::Vector2d> PathFlight::remaining_map_m() const {
  return plan() ? keeper_.remaining() : std::vector<Eigen::Vector2d>{};
}

Eigen::Vector2d PathFlight::wantedVelocity_map_m_s() const {
  return velocityAlong(remaining_map_m(), std::min(pace_m_s_, controller_.speed_m_s(mode_)));
}

}  // namespace swiftlet::autonomy
