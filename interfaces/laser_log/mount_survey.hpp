// Determines where the laser is mounted, and whether the odometry is that of the robot or of the laser, from records
// that give both poses.
//
// A mount is rigid, so the distance between both poses is constant; then their relative pose is the mount. It is not
// constant if one of the poses was corrected and the other was not, or was never filled in. Then the laser is taken to
// be in the robot's centre.
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry.hpp"

namespace swiftlet::interfaces {

struct LaserMount {
  common::Pose2 T_robot_laser;
  bool rigid = true;
  /// The robot's pose stands still while the laser's moves: it was never filled in, and the laser's pose is the
  /// odometry.
  bool robot_stands = false;
};

/// Whether the poses of a record agree with the mount, within the precision of logs.
bool agrees(const common::Pose2& T_robot_laser, const LaserMount& mount);

class MountSurvey {
 public:
  void add(const common::Pose2& T_odom_laser, const common::Pose2& T_odom_robot);
  /// No more records are needed: there are enough and a pose has moved far enough, or it never will.
  bool decided() const;
  LaserMount result() const;

 private:
  std::vector<common::Pose2> mounts_;  ///< T_robot_laser of each record.
  common::Pose2 first_laser_, first_robot_;
  double laser_moved_m_ = 0.0, robot_moved_m_ = 0.0;  ///< Greatest distances from the first pose.
};

}  // namespace swiftlet::interfaces
