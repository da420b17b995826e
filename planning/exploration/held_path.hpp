// Whether a path stays where there are walls around, by which the laser knows the position.
#pragma once

#include <span>

#include <Eigen/Core>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// Whether there are walls around a place (hasWallsToMatch). A place outside the map counts as held, because it is
/// unknown.
bool isHeld(const CostMap& map, const Eigen::Vector2d& place_map_m);

/// Whether the path ends at a held place, without a stretch of more than 4 m that is not. The stretch that
/// the vehicle is in at its start does not count, because it has to leave it.
bool staysHeld(const CostMap& map, std::span<const Eigen::Vector2d> path_map_m);

}  // namespace swiftlet::planning
