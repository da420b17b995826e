// The motion of a robot while its laser sweeps. A laser that turns slowly (RPLIDAR, LDS: 5 to 10 turns a second) sees
// the room from another pose with every beam.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::perception {

/// Poses of the robot at evenly spaced times, from the first beam in time to the last. Linear between them; the yaw is
/// not wrapped.
struct SweepMotion {
  std::vector<common::Pose2> knots;

  /// The pose at a share of the sweep's time, in [0, 1]. There must be a knot.
  common::Pose2 at(double share) const;
};

/// Time from the first beam to the last. A scan whose `time_increment` is negative was measured from its last beam to
/// its first.
common::Duration sweepTime(const common::LaserScan& scan);

/// Share of the sweep's time at which a beam was measured.
double timeShare(const common::LaserScan& scan, std::size_t beam);

/// An end point in the frame of the robot at the time of its beam.
struct SweptPoint {
  Eigen::Vector2d point_m;
  double share = 0.0;  ///< Of the time of the sweep.
};

/// The beams that have hit something, in their order.
std::vector<SweptPoint> sweptPoints(const common::LaserScan& scan, const common::Pose2& T_robot_laser);

}  // namespace swiftlet::perception
