// A floor plan: what of a voxel map lies within a band of heights.
#pragma once

#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// Heights in the frame of the map. Both ends belong to the band.
struct HeightBand {
  double low_m = 0.0;
  double high_m = 0.0;
};

/// A cell is occupied where any voxel of its column within the band is, and free where at least one is free and none is
/// occupied. The cells are those of the voxels.
common::OccupancyGrid floorPlan(const common::VoxelMap& map, const HeightBand& band);

}  // namespace swiftlet::mapping3d
