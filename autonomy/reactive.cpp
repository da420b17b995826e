#include "autonomy/reactive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

namespace {

/// The points of both in the order of their bearing; empty if the camera adds nothing.
std::vector<Eigen::Vector2f> withCamera(const ReactiveInput& input) {
  if (input.camera_points_level_m.empty()) return {};
  std::vector<Eigen::Vector2f> points = input.scan.points_level_m;
  points.insert(points.end(), input.camera_points_level_m.begin(), input.camera_points_level_m.end());
  const auto bearing = [](const Eigen::Vector2f& point) { return std::atan2(point.y(), point.x()); };
  std::erase_if(points, [](const Eigen::Vector2f& point) { return !point.allFinite(); });
  std::stable_sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return bearing(a) < bearing(b); });
  return points;
}

}  // namespace

void ReactiveConfig::describe(common::config::Fields& fields) {
  fields.section("avoidance", avoidance, "Braking and retreat.");
}

Reactive::Reactive(const ReactiveConfig& config, double hull_radius_m) : avoidance_(config.avoidance, hull_radius_m) {
  decision_.speed_limit_m_s = std::numeric_limits<double>::infinity();
}

const planning::AvoidanceDecision& Reactive::update(const ReactiveInput& input) {
  const Eigen::Rotation2Dd level_from_map(-input.T_map_body.yaw_rad);
  planning::AvoidanceInput seen;
  seen.stamp = input.scan.stamp;
  seen.age_s = input.age_s;
  seen.position_sigma_m = input.drift_m;
  const std::vector<Eigen::Vector2f> merged = withCamera(input);
  seen.points_level_m = merged.empty() ? std::span<const Eigen::Vector2f>(input.scan.points_level_m) : merged;
  seen.velocity_level_m_s = level_from_map * Eigen::Vector2d(input.state.velocity_map_m_s().head<2>());
  seen.wanted_level_m_s = level_from_map * input.wanted_map_m_s;
  seen.T_map_level = input.T_map_body;
  seen.cost_map = input.cost_map;
  seen.keep_out_points_level_m = input.keep_out_points_level_m;
  seen.obstacles = input.obstacles;
  decision_ = avoidance_.update(seen);
  return decision_;
}

}  // namespace swiftlet::autonomy
