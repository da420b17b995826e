// Something that the map does not explain, followed over scans: mostly a person.
#pragma once

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::common {

/// In the `map` frame.
struct DynamicObstacle {
  int id = 0;                                              ///< Stays with it as long as it is followed.
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();  ///< At `last_seen`.
  double radius_m = 0.0;
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();  ///< Not to be believed unless `moving`.
  bool moving = false;                                         ///< It has left the place where it was seen first.
  Time last_seen;

  Eigen::Vector2d believedVelocity_map_m_s() const { return moving ? velocity_map_m_s : Eigen::Vector2d::Zero(); }
};

}  // namespace swiftlet::common
