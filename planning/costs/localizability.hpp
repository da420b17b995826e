// How well the laser fixes x, y and yaw at a place: the information matrix of the walls it would see there (Bachrach
// 2009, section 5.4: the ability of the vehicle to localize itself). A long corridor fixes one direction only.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "planning/costs/cost_map.hpp"
#include "planning/costs/sight.hpp"

namespace swiftlet::planning {

/// A return expected from a wall, relative to the place, with the wall's unit normal.
struct WallReturn {
  Eigen::Vector2d offset_m;
  Eigen::Vector2d normal;
};

/// The normal of the occupied cells around a cell, from their principal axis; zero if there is none (a lone cell).
Eigen::Vector2d wallNormal(const CostMap& map, int index);

/// From 0 (some direction, or the yaw, is not fixed at all) to 1 (walls all around). `beams` is the number of all
/// beams, including those without return.
double localizability(const std::vector<WallReturn>& returns, int beams);

/// How much there is to match around a place: of the rays in `directions` up to `range_m`, the share that meets a wall,
/// among those whose end is known. A ray that leaves the known space within `open_m` may yet meet a wall and does not
/// count; one that crosses as much free space without a wall counts as open. 1 if the end of no ray is known.
double wallShareAt(const CostMap& map, common::CellIndex place, double range_m, double open_m,
                   const Directions& directions);

/// Whether there are enough walls around the place to match a scan with. They may fail to fix the position along one
/// direction, as those of a corridor do.
bool hasWallsToMatch(const CostMap& map, common::CellIndex place, const Directions& directions);

}  // namespace swiftlet::planning
