// A piece of the 3D map, drawn around one key scan of the 2D map and moving with it.
//
// A loop closure moves the key scans, so what hangs on them is right at once and is not drawn again; only what fuses
// all submaps into one grid must be made anew.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::common {

/// A small piece of a surface.
struct SurfacePoint {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< Unit, towards the camera that saw it; zero if not known.
  std::array<std::uint8_t, 3> rgb{};
};

/// Immutable once published. Coordinates are those of the frame `submap`, whose z axis is vertical.
struct Submap3d {
  int key = 0;                                              ///< Index into KeyPoses::keys.
  Pose3 T_key_submap;                                       ///< Relative to the level frame of that key scan.
  std::shared_ptr<const std::vector<SurfacePoint>> points;  ///< Never null.
  std::shared_ptr<const VoxelMap> voxels;                   ///< Never null.

  /// The key scan must be in `keys`.
  Pose3 T_map_submap(const KeyPoses& keys) const { return keys.inMap({key, T_key_submap}); }
};

}  // namespace swiftlet::common
