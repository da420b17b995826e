// Between voxels and points, for files of either kind.
#pragma once

#include <vector>

#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// The centres of the occupied voxels, grey and without normals, in ascending order of their blocks.
std::vector<common::SurfacePoint> occupiedCenters(const common::VoxelMap& map);

/// A voxel is occupied where at least one point is; nothing is known to be free. Points that are not finite, or farther
/// from the origin than an octree of OctoMap reaches, are left out.
common::VoxelMap voxelsAround(const std::vector<common::SurfacePoint>& points, double resolution_m);

}  // namespace swiftlet::mapping3d
