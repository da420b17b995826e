// Where the laser sits on the robot, and which of the two the odometry is of, from records that give a pose of each.
//
// A mount is rigid, so both poses keep one distance; where they do, that is the mount. They do not where one of them
// was corrected and the other left as it was, or never filled in: then the laser is taken to be in the robot's centre,
// for no distance between them means anything.
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry.hpp"

namespace swiftlet::interfaces {

struct LaserMount {
  common::Pose2 T_robot_laser;
  bool rigid = true;
  /// The robot's pose stands still while the laser's moves: it was never filled in, and the laser's is the odometry.
  bool robot_stands = false;
};

/// Whether a record has the laser where the mount has it, as far as logs are printed and clocks agree.
bool agrees(const common::Pose2& T_robot_laser, const LaserMount& mount);

class MountSurvey {
 public:
  void add(const common::Pose2& T_odom_laser, const common::Pose2& T_odom_robot);
  /// There are records enough, and a pose has moved far enough to tell. Or it never will: no more need to be given.
  bool decided() const;
  LaserMount result() const;

 private:
  std::vector<common::Pose2> mounts_;  ///< T_robot_laser as each record has it.
  common::Pose2 first_laser_, first_robot_;
  double laser_moved_m_ = 0.0, robot_moved_m_ = 0.0;  ///< Farthest from the first.
};

}  // namespace swiftlet::interfaces
