#include "perception/projection/placed_returns.hpp"

#include <cmath>
#include <cstdint>

namespace swiftlet::perception {

std::vector<PlacedReturn> placeReturns(const common::LaserScan& scan, const common::LaserConfig& laser,
                                       const PoseAt& pose_at, double body_radius_m) {
  const common::Pose3 T_body_laser = laser.mount.pose();
  std::vector<PlacedReturn> returns;
  returns.reserve(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const auto range_m = static_cast<double>(scan.ranges_m[beam]);
    if (!(range_m >= scan.range_min_m && range_m > 0.0 && range_m <= scan.range_max_m)) continue;
    const double angle_rad = scan.angle_min_rad + static_cast<double>(beam) * scan.angle_increment_rad;
    const Eigen::Vector3d end_laser_m(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0);
    const Eigen::Vector3d end_body_m = T_body_laser * end_laser_m;
    if (end_body_m.squaredNorm() < body_radius_m * body_radius_m) continue;
    const common::Pose3 pose = pose_at(scan.stamps.measured + scan.time_increment * static_cast<std::int64_t>(beam));
    returns.push_back({pose * T_body_laser.position_m, pose * end_body_m});
  }
  return returns;
}

}  // namespace swiftlet::perception
