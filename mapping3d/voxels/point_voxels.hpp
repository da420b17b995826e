// Between voxels and points, for files of either kind.
#pragma once

#include <cstddef>
#include <vector>

#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

std::size_t occupiedCount(const common::VoxelMap& map);

/// The centres of the occupied voxels, grey and without normals, in ascending order of their blocks.
std::vector<common::SurfacePoint> occupiedCenters(const common::VoxelMap& map);

struct PointVoxels {
  common::VoxelMap map;
  std::size_t left_out = 0;  ///< Points that are not finite, or farther from the origin than octreeReach_m().
  bool full = false;         ///< The points need more blocks than are allowed; the map has only the first points.
};

/// How far from the origin an octree of OctoMap reaches along each axis.
double octreeReach_m(double resolution_m);

/// A voxel is occupied where at least one point is; nothing is known to be free. Scattered points make a block
/// of 8 x 8 x 8 voxels each, so at most `most_blocks` blocks are made.
PointVoxels voxelsAround(const std::vector<common::SurfacePoint>& points, double resolution_m, std::size_t most_blocks);

}  // namespace swiftlet::mapping3d
