// An object that the map does not explain, tracked over scans; usually a person. What a person may do next.
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

/// What a person may do: walk on from a place with a velocity. In `map`.
struct PossibleWalk {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();
  double weight = 1.0;  ///< Positive.
};

/// Half the breadth of a person's shoulders: of 95 % of men it is at most 0.255 m (Pheasant, Bodyspace, 1996,
/// Table 10.1).
inline constexpr double kPersonHalfWidth_m = 0.25;
/// What the map shows this near to where a person walked may be that person.
inline constexpr double kPersonInMap_m = 0.45;

}  // namespace swiftlet::common
