// Whether one place can be seen from another, by the map.
#pragma once

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"

namespace swiftlet::common {

/// No occupied cell lies between the two places, in the plane at the height of flight. The last `near_m` before `to`
/// are not checked, because what stands there is itself in the map.
inline bool isInSight(const OccupancyGrid& grid, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m,
                      double near_m) {
  const Eigen::Vector2d displacement_map_m = to_map_m - from_map_m;
  const double length_m = displacement_map_m.norm() - near_m, step_m = 0.7 * grid.resolution_m();
  for (double along_m = 0.0; along_m < length_m; along_m += step_m)
    if (occupancy::isOccupied(
            grid.at(grid.cellAt(from_map_m + along_m / displacement_map_m.norm() * displacement_map_m))))
      return false;
  return true;
}

}  // namespace swiftlet::common
