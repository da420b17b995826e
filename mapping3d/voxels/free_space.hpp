// The free space of a building, from what there is of it: a floor plan, an octree or a cloud of points. What is not
// known to be free is matter, so that the space is closed.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"
#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"
#include "mapping3d/voxels/bit_volume.hpp"

namespace swiftlet::mapping3d {

/// Voxels that a space may have: a quarter of a gigabyte for each of its volumes.
inline constexpr double kMostSpaceVoxels = 2e9;

/// Voxel (x, y, z) begins at corner_m + (x, y, z) * voxel_m, in the frame of the map.
struct FreeSpace {
  BitVolume free;
  BitVolume measured;  ///< Where something was measured. What is neither is unknown.
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d voxel_m = Eigen::Vector3d::Ones();  ///< Its sides: the one layer of a plan is as high as its walls.
  bool open_below = false;  ///< Nothing is known of what is below the box: the lowest layer stands on no floor.

  Eigen::Vector3d cornerOf_m(int x, int y, int z) const {
    return corner_m + Eigen::Vector3d(x, y, z).cwiseProduct(voxel_m);
  }
};

/// A box of voxels that would hold what is known, before it is made.
struct SpaceExtent {
  common::VoxelIndex begin, end;  ///< Half-open.
  double voxels() const { return static_cast<double>(end.x - begin.x) * (end.y - begin.y) * (end.z - begin.z); }
};

/// One layer from z = 0 to height_m. Unknown cells are free if at least three of their four neighbours are, since beams
/// spread and leave such specks, or if they are a part that nothing but free cells surrounds, since a surface in it
/// would have been measured. The grid must have a known cell.
FreeSpace freeSpaceOf(const common::OccupancyGrid& plan, double height_m);

/// The blocks of an octree. A block at least must be known.
SpaceExtent extentOf(const common::VoxelMap& map);
/// Unknown voxels are free if at least four of their six neighbours are, or as a part that nothing but free ones
/// surrounds. The extent must have at most kMostSpaceVoxels.
FreeSpace freeSpaceOf(const common::VoxelMap& map);

/// The distance from a point to its fourth neighbour, as it is for all but a twentieth of the points: on a lattice
/// that is its spacing. Of 2,000 points, evenly drawn; `farthest_m` where that many neighbours are not within it.
double spacingOf_m(const std::vector<common::SurfacePoint>& points, double farthest_m);

/// For points that far apart, by spacingOf_m: wider, so that each voxel of a wall has a point, in whole centimetres, so
/// that it can be said, and no finer than the maps that flights leave.
double voxelSideOf_m(double spacing_m);

/// Of the voxels around points, with `margin` more on each side. The points must be finite.
SpaceExtent extentOf(const std::vector<common::SurfacePoint>& points, double voxel_m, int margin);
/// All is free where no point is, which includes what is behind the surfaces. The extent must have at most
/// kMostSpaceVoxels.
FreeSpace spaceAround(const std::vector<common::SurfacePoint>& points, double voxel_m, int margin);

/// Closes holes of a surface up to twice `radius` voxels wide: what is not measured is free, but for a morphological
/// closing of what is by a cube. The space needs a margin of more than `radius`.
void closeHoles(FreeSpace& space, int radius);

/// Keeps of the free space what a free voxel is connected with by faces. Returns whether that touches the box.
bool keepConnected(FreeSpace& space, common::VoxelIndex seed);

/// The share of the lowest free voxels of all columns that have a measured one below; 0 without free ones.
double measuredFloorShare(const FreeSpace& space);

/// What is below or above is no longer free; the nearest planes between voxels count. Returns that plane.
double raiseFloor(FreeSpace& space, double floor_m);
double lowerCeiling(FreeSpace& space, double ceiling_m);

}  // namespace swiftlet::mapping3d
