#include "interfaces/laser_log/scan_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace swiftlet::interfaces {
namespace {

using common::LaserScan;
using common::Message;

/// A whole turn, plus one beam that some lasers repeat.
constexpr double kWidestFan_rad = 2.0 * std::numbers::pi + 0.1;
/// No laser has a longer range. Logs that claim one mean that nothing was seen.
constexpr double kGreatestRange_m = 1000.0;

/// A laser that hangs upside down sees everything from the other side: turned about its own x axis, it is upright.
void mirror(LaserScan& scan) {
  scan.angle_min_rad =
      -(scan.angle_min_rad + scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0));
  scan.time_increment = -scan.time_increment;
  std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
}

void useSensor(const common::LaserConfig& sensor, LoggedScan& logged) {
  LaserScan& scan = logged.scan;
  const double steps = std::max(1.0, static_cast<double>(scan.ranges_m.size()) - 1.0);
  scan.angle_min_rad = sensor.angleMin_rad();
  scan.angle_increment_rad = -2.0 * scan.angle_min_rad / steps;
  scan.range_min_m = sensor.range_min_m;
  scan.range_max_m = sensor.range_max_m;
  const common::Pose3 T_robot_laser = sensor.mount.pose();
  logged.T_robot_laser = common::planar(T_robot_laser);
  if ((T_robot_laser.rotation * Eigen::Vector3d::UnitZ()).z() < 0.0) mirror(scan);
}

std::optional<Message> geometryProblem(const LaserScan& scan) {
  const double fan_rad = scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  if (!std::isfinite(scan.angle_min_rad) || std::abs(scan.angle_min_rad) > kWidestFan_rad)
    return Message("scan.first-beam", "no laser has a first beam at {} rad, give its data sheet by --sensor",
                   scan.angle_min_rad);
  if (scan.ranges_m.size() > 1 && !(scan.angle_increment_rad > 0.0 && fan_rad <= kWidestFan_rad))
    return Message("scan.spacing", "no laser has {} beams, {} rad apart, give its data sheet by --sensor",
                   scan.ranges_m.size(), scan.angle_increment_rad);
  if (!std::isfinite(scan.range_max_m) || !(scan.range_min_m >= 0.0) || !(scan.range_max_m > scan.range_min_m))
    return Message("scan.ranges", "no laser has ranges from {} m to {} m, give its data sheet by --sensor",
                   scan.range_min_m, scan.range_max_m);
  return std::nullopt;
}

}  // namespace

std::optional<Message> completeScan(const std::optional<common::LaserConfig>& sensor, LoggedScan& logged) {
  if (sensor) useSensor(*sensor, logged);
  LaserScan& scan = logged.scan;
  if (auto problem = geometryProblem(scan)) return problem;
  scan.range_max_m = std::min(scan.range_max_m, kGreatestRange_m);
  const auto farthest_m = static_cast<float>(scan.range_max_m);
  for (float& range_m : scan.ranges_m) {
    if (range_m < 0.0F) range_m = std::numeric_limits<float>::quiet_NaN();
    if (range_m >= farthest_m) range_m = std::numeric_limits<float>::infinity();
  }
  return std::nullopt;
}

}  // namespace swiftlet::interfaces
