// Projection of a slow sweep whose motion is known.
#pragma once

#include "perception/laser_odometry/sweep_motion.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// Projects the sweep of a laser that is carried level by a robot that moves during the sweep. The stamp and the level
/// frame of the result are those of the first beam in time, at which the robot is at `T_odom_robot`.
ProjectedScan projectSwept(const common::LaserScan& scan, const common::Pose2& T_robot_laser,
                           const common::Pose2& T_odom_robot, const SweepMotion& motion);

}  // namespace swiftlet::perception
