#include "planning/avoidance/retreat_rules.hpp"

#include <algorithm>
#include <limits>

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

/// Distance from the hull within which a return repels.
constexpr double kFieldRange_m = 1.0;
constexpr double kNearest_m = 0.02;  // At distance zero the force would be infinite.

/// The repulsive force of one point at that place of the level frame.
Vector2d force(const Vector2d& place_m, double gap_m) {
  const double distance_m = std::max(gap_m, kNearest_m);
  if (distance_m >= kFieldRange_m || place_m.isZero()) return Vector2d::Zero();
  return -place_m.normalized() * (1.0 / distance_m - 1.0 / kFieldRange_m) / (distance_m * distance_m);
}

}  // namespace

Vector2d oppositeVelocity(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input) {
  const Threat* nearest = nullptr;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Threat& threat : input.threats) {
    const double gap_m = threat.gapTo(hull_radius_m, Vector2d::Zero(), 0.0);
    if (!threat.dangerous || threat.center_m.isZero() || gap_m >= least_m) continue;
    least_m = gap_m;
    nearest = &threat;
  }
  if (nearest == nullptr) return Vector2d::Zero();
  return -config.retreat_speed_m_s * nearest->center_m.normalized();
}

Vector2d potentialFieldVelocity(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input) {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& point_m : input.points_level_m) sum += force(point_m, point_m.norm() - hull_radius_m);
  // A threat repels as strongly as the many returns that a wall of its size would have.
  const double returns_each = std::max<double>(1.0, static_cast<double>(input.points_level_m.size()) / config.bins);
  for (const Threat& threat : input.threats)
    sum += returns_each * force(threat.center_m, threat.gapTo(hull_radius_m, Vector2d::Zero(), 0.0));
  constexpr double kCancelled = 1e-6;
  if (sum.norm() < kCancelled) return Vector2d::Zero();
  return config.retreat_speed_m_s * sum.normalized();
}

}  // namespace swiftlet::planning
