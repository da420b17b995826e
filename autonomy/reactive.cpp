#include "autonomy/reactive.hpp"

#include <cmath>
#include <limits>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {
namespace {

/// Local corrections are millimetres, loop closures are not.
constexpr double kCorrected_m = 0.05;
constexpr double kCorrected_rad = 0.01;

constexpr double kJustSeen_s = 0.15;
/// A body's outline beyond what was seen of it.
constexpr double kAround_m = 0.20;

}  // namespace

void ReactiveConfig::describe(common::config::Fields& fields) {
  fields.section("avoidance", avoidance, "Braking and retreat.");
  fields.section("dynamic_obstacles", dynamic_obstacles, "People and other things that move.");
}

std::vector<std::string> ReactiveConfig::problemsWith(double clearance_m) const {
  return avoidance.validateAgainst(clearance_m, dynamic_obstacles.keep_out_m);
}

Reactive::Reactive(const ReactiveConfig& config, double hull_radius_m, const perception::GridDrawingConfig& drawing)
    : above_m_(static_cast<float>(drawing.max_height_above_m)),
      below_m_(static_cast<float>(drawing.max_height_below_m)),
      avoidance_(config.avoidance, hull_radius_m),
      background_(common::Duration::fromSeconds(config.dynamic_obstacles.background_age_s)),
      obstacles_(config.dynamic_obstacles) {
  decision_.speed_limit_m_s = std::numeric_limits<double>::infinity();
}

const planning::AvoidanceDecision& Reactive::update(const perception::ProjectedScan& scan,
                                                    const common::Pose2& T_map_body, const common::VehicleState& state,
                                                    const Eigen::Vector2d& wish_map_m_s,
                                                    const std::shared_ptr<const common::OccupancyGrid>& grid,
                                                    const planning::CostMap* cost_map) {
  // A corrected map explains nothing that was seen against the old one.
  const common::Pose2 jump = T_map_odom_.inverse() * state.T_map_odom;
  if (jump.position_m().norm() > kCorrected_m || std::abs(jump.yaw_rad) > kCorrected_rad) background_.restart();
  T_map_odom_ = state.T_map_odom;
  background_.add(scan.stamp, grid);
  std::vector<Eigen::Vector2f> points_map_m;
  points_map_m.reserve(scan.points_level_m.size());
  constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    // What is above or below the hull's way is not in the background.
    const bool in_the_way = scan.heights_level_m[i] <= above_m_ && scan.heights_level_m[i] >= -below_m_;
    points_map_m.push_back(
        in_the_way
            ? Eigen::Vector2f((T_map_body * Eigen::Vector2d(scan.points_level_m[i].cast<double>())).cast<float>())
            : Eigen::Vector2f(kNowhere, kNowhere));
  }
  if (const auto background = background_.at(scan.stamp))
    obstacles_.update(scan.stamp, points_map_m, T_map_body.position_m(), *background);

  const Eigen::Rotation2Dd level_from_map(-T_map_body.yaw_rad);
  planning::AvoidanceInput input;
  input.stamp = scan.stamp;
  input.points_level_m = scan.points_level_m;
  input.velocity_level_m_s = level_from_map * Eigen::Vector2d(state.velocity_map_m_s().head<2>());
  input.wish_level_m_s = level_from_map * wish_map_m_s;
  input.T_map_level = T_map_body;
  input.cost_map = cost_map;
  input.obstacles = obstacles_.obstacles();
  decision_ = avoidance_.update(input);
  return decision_;
}

std::vector<planning::Disc> Reactive::people(common::Time stamp) const {
  std::vector<planning::Disc> result;
  for (const planning::DynamicObstacle& o : obstacles_.obstacles()) {
    const double age_s = (stamp - o.last_seen).seconds();
    if (age_s > kJustSeen_s) continue;
    result.push_back({o.center_map_m + o.believedVelocity_map_m_s() * age_s, o.radius_m + kAround_m});
  }
  return result;
}

}  // namespace swiftlet::autonomy
