// The surface of a TSDF as triangles.
#pragma once

#include "common/surface_mesh.hpp"
#include "mapping3d/surface/tsdf_volume.hpp"

namespace swiftlet::mapping3d {

/// Surface nets (S. Gibson, "Constrained Elastic Surface Nets", MICCAI 1998, without the relaxation): one vertex in
/// each cube of eight voxel centres that the surface crosses, at the mean of where the distance is zero on its edges,
/// with the mean colour there. Triangles share their vertices and are seen counter-clockwise from in front of the
/// surface. Where a voxel was never seen there is no surface, and none between a voxel behind an edge and the free
/// space beside it: over one voxel a distance changes by no more than that voxel, seen at up to 75 degrees. The same
/// volume gives the same bytes; one thread.
common::SurfaceMesh surfaceNet(const TsdfVolume& volume);

}  // namespace swiftlet::mapping3d
