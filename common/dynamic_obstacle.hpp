// An object that the map does not explain, tracked over scans; usually a person.
#pragma once

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::common {

/// In the `map` frame.
struct DynamicObstacle {
  int id = 0;                                              ///< Constant while it is tracked.
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();  ///< At `last_seen`.
  double radius_m = 0.0;
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();  ///< Reliable only if `moving`.
  bool moving = false;                                         ///< It has left the place where it was first seen.
  Time last_seen;

  Eigen::Vector2d believedVelocity_map_m_s() const { return moving ? velocity_map_m_s : Eigen::Vector2d::Zero(); }
};

}  // namespace swiftlet::common
