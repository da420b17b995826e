#include "perception/laser_odometry/sweep_motion.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {

using common::Pose2;

Pose2 SweepMotion::at(double share) const {
  if (knots.size() == 1) return knots.front();
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(knots.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), knots.size() - 2);
  const double part = place - static_cast<double>(k);
  const Pose2 &a = knots[k], &b = knots[k + 1];
  return {std::lerp(a.x_m, b.x_m, part), std::lerp(a.y_m, b.y_m, part), std::lerp(a.yaw_rad, b.yaw_rad, part)};
}

common::Duration sweepTime(const common::LaserScan& scan) {
  const common::Duration step = std::max(scan.time_increment, -scan.time_increment);
  return step * (std::max<std::int64_t>(static_cast<std::int64_t>(scan.ranges_m.size()), 1) - 1);
}

double timeShare(const common::LaserScan& scan, std::size_t beam) {
  const double last = std::max(static_cast<double>(scan.ranges_m.size()) - 1.0, 1.0);
  const double share = static_cast<double>(beam) / last;
  return scan.time_increment < common::Duration() ? 1.0 - share : share;
}

std::vector<SweptPoint> sweptPoints(const common::LaserScan& scan, const Pose2& T_robot_laser) {
  std::vector<SweptPoint> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.range_min_m && range_m > 0.0 && range_m <= scan.range_max_m)) continue;
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Eigen::Vector2d point_laser_m(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    points.push_back({T_robot_laser * point_laser_m, timeShare(scan, i)});
  }
  return points;
}

}  // namespace swiftlet::perception
