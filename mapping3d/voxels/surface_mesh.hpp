// The surfaces of a voxel map as triangles, for programs that show or measure meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/submap3d.hpp"
#include "common/surface_mesh.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// Surface nets (Gibson 1998): one vertex in each cube of eight voxel centres in which known free and occupied space
/// meet, at the mean of where the log odds change their sign on its edges. Where unknown space meets occupied there is
/// no surface. A vertex near `points` of the same frame moves to their mean and takes their colour; others are grey.
/// Triangles are seen counter-clockwise from free space. The same arguments give the same bytes; one thread.
common::SurfaceMesh surfaceMesh(const common::VoxelMap& map, std::span<const common::SurfacePoint> points);

}  // namespace swiftlet::mapping3d
