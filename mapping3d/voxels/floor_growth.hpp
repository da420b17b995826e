// The floor of a building where it was not measured everywhere: below a scanner, behind things, in a sparse cloud.
#pragma once

#include <optional>

#include "mapping3d/voxels/free_space.hpp"
#include "mapping3d/voxels/standing_place.hpp"

namespace swiftlet::mapping3d {

/// Grows a floor from column to column, from the measured one nearest to a start. It rises and sinks with what was
/// measured, by a step at most; where nothing was, it stays level, up to 1.5 m far. It ends at walls: where above it
/// the hull has no room. Where it is a voxel off the median within the radius of the room, it is level with that. What
/// is unknown between floor and free space, or between that and the ceiling, is free too; a column without a ceiling
/// has that of the column before it. In a cloud, a column that the floor does not reach is not free. Returns false, and
/// changes nothing, if no floor was measured within 1.5 m of the start.
bool growFloor(FreeSpace& space, const Eigen::Vector2d& start_m, const StandingRoom& room, double hull_height_m,
               std::optional<double> height_m);

}  // namespace swiftlet::mapping3d
