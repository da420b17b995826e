#include "autonomy/reactive.hpp"

#include <limits>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

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
  seen.points_level_m = input.scan.points_level_m;
  seen.map3d_points_level_m = input.map3d_points_level_m;
  seen.velocity_level_m_s = level_from_map * Eigen::Vector2d(input.state.velocity_map_m_s().head<2>());
  seen.wanted_level_m_s = level_from_map * input.wanted_map_m_s;
  seen.T_map_level = input.T_map_body;
  seen.clearance = input.clearance;
  seen.keep_out_points_level_m = input.keep_out_points_level_m;
  seen.obstacles = input.obstacles;
  decision_ = avoidance_.update(seen);
  return decision_;
}

}  // namespace swiftlet::autonomy
