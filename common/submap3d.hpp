// A piece of the 3D map, drawn around one key scan of the 2D map and moving with it.
//
// A loop closure moves the key scans, so what is stored relative to them is right at once and is not drawn again; only
// the grid fused from all submaps must be made again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::common {

/// Of a surface whose colour was not measured.
inline constexpr std::array<std::uint8_t, 3> kUnknownColor{160, 160, 160};

/// A small piece of a surface.
struct SurfacePoint {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< Unit, towards the camera that saw it; zero if not known.
  std::array<std::uint8_t, 3> rgb{};
};

/// Where a surface was seen only with much noise, its points are averaged in cubes of this many times the side, and are
/// as much farther apart (docs/decisions/mapping3d.md#099). It is eight times the least noise that goes there, so that
/// a flat surface is mostly in one layer of them, and half of what the figures of the cloud call covered.
inline constexpr double kLargeCube = 4.0;

/// Immutable once published. Coordinates are those of the frame `submap`, whose z axis is vertical.
struct Submap3d {
  int key = 0;                                              ///< Index into KeyPoses::keys.
  Pose3 T_key_submap;                                       ///< Relative to the level frame of that key scan.
  std::shared_ptr<const std::vector<SurfacePoint>> points;  ///< Never null.
  std::shared_ptr<const VoxelMap> voxels;                   ///< Never null.
  double cube_m = 0.02;                                     ///< Side of the cubes each of which has one point.
  std::size_t coarse = 0;  ///< Number of points, the last ones, that have cubes of kLargeCube times that side.
  /// The numbers of the first and the last frame drawn into it; each frame is drawn into one submap.
  std::uint64_t first_frame = 0, last_frame = 0;

  std::size_t fine() const { return points->size() - coarse; }
  /// The key scan must be in `keys`.
  Pose3 T_map_submap(const KeyPoses& keys) const { return keys.inMap({key, T_key_submap}); }
};

}  // namespace swiftlet::common
