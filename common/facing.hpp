// Where the nose points along a path.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace swiftlet::common {

/// A place of a path and the yaw there. Between two places the yaw turns evenly, the shorter way round.
struct Facing {
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< In the frame of the path, as the yaw.
  double yaw_rad = 0.0;
  /// Greatest speed from here to the next place, where the vehicle does not see where it flies.
  double speed_m_s = std::numeric_limits<double>::infinity();
};

}  // namespace swiftlet::common
