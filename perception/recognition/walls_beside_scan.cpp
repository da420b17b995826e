#include "perception/recognition/walls_beside_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace swiftlet::perception {
namespace {

constexpr int kSteps = 720;
/// Farther walls are seen by fewer beams than a reflection needs; bounded for speed.
constexpr double kFarthest_m = 15.0;

std::vector<bool> bearingsSeen(const common::LaserScan& scan) {
  std::vector<bool> seen(kSteps, false);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const float range_m = scan.ranges_m[i];
    if (std::isnan(range_m) || range_m < scan.range_min_m) continue;
    const double turns =
        (scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad) / (2.0 * std::numbers::pi);
    const int step = static_cast<int>(std::lround((turns - std::floor(turns)) * kSteps)) % kSteps;
    seen[static_cast<std::size_t>(step)] = true;
  }
  return seen;
}

}  // namespace

std::vector<Eigen::Vector3d> wallsBesideScan(const common::LaserScan& scan, const common::Pose3& T_map_laser,
                                             const common::OccupancyGrid& grid) {
  std::vector<Eigen::Vector3d> walls;
  const std::vector<bool> seen = bearingsSeen(scan);
  const double step_m = 0.7 * grid.resolution_m(), range_m = std::min(kFarthest_m, scan.range_max_m);
  for (int i = 0; i < kSteps; ++i) {
    if (seen[static_cast<std::size_t>(i)]) continue;
    const double angle_rad = 2.0 * std::numbers::pi * i / kSteps;
    const Eigen::Vector3d ray_laser(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const Eigen::Vector2d ray_map = (T_map_laser.rotation * ray_laser).head<2>(),
                          from_map_m = T_map_laser.position_m.head<2>();
    for (double along_m = step_m; along_m < range_m; along_m += step_m) {
      const common::occupancy::Cell cell = grid.at(grid.cellAt(from_map_m + along_m * ray_map));
      if (common::occupancy::isUnknown(cell)) break;
      if (!common::occupancy::isOccupied(cell)) continue;
      walls.push_back(along_m * ray_laser);
      break;
    }
  }
  return walls;
}

}  // namespace swiftlet::perception
