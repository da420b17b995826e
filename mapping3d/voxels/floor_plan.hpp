// A floor plan: what of a voxel map lies within a band of heights.
#pragma once

#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// A cell is occupied where any voxel of its column between the two heights is, and free where at least one is free and
/// none is occupied. Heights are in the frame of the map, and both belong to the band. The cells are those of the
/// voxels.
common::OccupancyGrid floorPlan(const common::VoxelMap& map, double low_m, double high_m);

}  // namespace swiftlet::mapping3d
