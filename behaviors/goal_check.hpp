// Whether a point the operator clicked can be a goal at all.
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"

namespace swiftlet::behaviors {

/// Why not: "(3.00, -1.50) is outside the map", "... is in an obstacle", "... is 0.12 m from an obstacle, the hull
/// needs 0.28 m"; empty when nothing speaks against it. Whether it can be reached only planning tells.
std::string goalProblem(const common::OccupancyGrid& grid, const Eigen::Vector2d& goal_map_m, double hull_radius_m);

}  // namespace swiftlet::behaviors
