// Where a vehicle that is about to fly blind should drift to: the open place near it, farthest from the walls.
#pragma once

#include <Eigen/Core>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// The displacement from `from_map_m` to the place whose obstacles are farthest, among those that are reached in a
/// straight line of at most `reach_m` through cells where the vehicle may be. Of two places the nearer one is preferred
/// where the gain is less than a quarter of the path length between. Zero if no place is better than this one.
Eigen::Vector2d displacementToOpenPlace_m(const CostMap& map, const Eigen::Vector2d& from_map_m, double reach_m);

}  // namespace swiftlet::planning
