#include "perception/recognition/mirror_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swiftlet::perception {
namespace {

/// Steps of bearing: half a degree, twice the step of a UTM-30LX.
constexpr int kBearings = 720;
/// Walls are upright, furniture is not everywhere: only what is this near to the laser's plane is compared.
constexpr double kNearPlane_m = 0.25;
/// The plane's tilt and distance, doubled by the reflection, and the noise of depth at 5 m.
constexpr double kSame_m = 0.15;
/// Fewer points that can be compared say nothing. So many in the same place are no chance, if fewer than half as many
/// are where the laser sees through, and fewer are where it does not see.
constexpr int kLeastSame = 8;

int bearingOf(const Eigen::Vector2d& direction) {
  const double turns = std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi);
  return (static_cast<int>(std::lround(turns * kBearings)) + kBearings) % kBearings;
}

}  // namespace

LevelScan::LevelScan(const common::LaserScan& scan, const common::Pose3& T_level_laser)
    : origin_m_(T_level_laser.position_m), ranges_m_(kBearings, 0.0) {
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isnan(scan.ranges_m[i]) || scan.ranges_m[i] < scan.range_min_m) continue;
    const double range_m = std::min(static_cast<double>(scan.ranges_m[i]), scan.range_max_m);
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    ends_m_.push_back(T_level_laser *
                      Eigen::Vector3d(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0));
    const Eigen::Vector2d from_laser = (ends_m_.back() - origin_m_).head<2>();
    double& range = ranges_m_[static_cast<std::size_t>(bearingOf(from_laser))];
    range = range > 0.0 ? std::min(range, from_laser.norm()) : from_laser.norm();
  }
}

void LevelScan::addSeenBefore(const std::vector<Eigen::Vector3d>& points_m) {
  std::vector<double> before_m(kBearings, 0.0);
  for (const Eigen::Vector3d& point : points_m) {
    const Eigen::Vector2d from_laser = (point - origin_m_).head<2>();
    double& range = before_m[static_cast<std::size_t>(bearingOf(from_laser))];
    range = range > 0.0 ? std::min(range, from_laser.norm()) : from_laser.norm();
  }
  for (std::size_t i = 0; i < ranges_m_.size(); ++i)
    if (!(ranges_m_[i] > 0.0)) ranges_m_[i] = before_m[i];
}

double LevelScan::rangeTowards_m(const Eigen::Vector3d& point_m) const {
  return ranges_m_[static_cast<std::size_t>(bearingOf((point_m - origin_m_).head<2>()))];
}

Reflection reflectionOf(const std::vector<Eigen::Vector3d>& behind_m, const WallPlane& wall, const LevelScan& scan) {
  const Eigen::Vector3d normal = wall.normal();
  int same = 0, through = 0, hidden = 0;
  for (const Eigen::Vector3d& point : behind_m) {
    if (std::abs(point.z() - scan.origin_m().z()) > kNearPlane_m) continue;
    const Eigen::Vector3d reflected = point - 2.0 * (normal.dot(point) - wall.distance_m()) * normal;
    const double range_m = scan.rangeTowards_m(reflected);
    if (!(range_m > 0.0)) continue;
    const double farther_m = range_m - (reflected - scan.origin_m()).head<2>().norm();
    if (std::abs(farther_m) < kSame_m)
      ++same;
    else
      ++(farther_m > 0.0 ? through : hidden);
  }
  if (same + through + hidden < kLeastSame) return Reflection::kMaybe;
  return same >= kLeastSame && same > 2 * through && same > hidden ? Reflection::kYes : Reflection::kNo;
}

}  // namespace swiftlet::perception
