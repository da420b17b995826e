// A truncated signed distance function (TSDF) in hashed blocks of voxels: for each voxel near a surface, how far it is
// in front of it, averaged over all frames. The surface is where the mean is zero (surface_net.hpp).
//
// Sources: B. Curless, M. Levoy, "A Volumetric Method for Building Complex Models from Range Images", SIGGRAPH 1996,
// sections 3 (the weighted mean) and 4 (space that is seen to be empty); M. Niessner et al., "Real-time 3D
// Reconstruction at Scale using Voxel Hashing", TOG 2013 (blocks of 8 x 8 x 8 voxels, by a hash of their place).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/voxel_map.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct TsdfConfig {
  double resolution_m = 0.02;           ///< Side of a voxel. The surface is found between voxels, to a fraction of it.
  double range_max_m = 5.0;             ///< Farther surfaces are left out.
  std::size_t blocks_max = 300'000;     ///< Blocks at most, 6 kB each.
  vision::DepthNoiseConfig noise = {};  ///< Only sigma_m() is used.
};

struct TsdfVoxel {
  float distance_m = 0.0F;   ///< Of its centre from the surface, along the view; positive in front of it.
  float weight_1_m2 = 0.0F;  ///< The inverse variance of that mean; 0: never seen.
  std::array<std::uint8_t, 3> rgb{};
  bool has_color = false;  ///< It was once seen near a surface.
};

struct TsdfBlock {
  std::array<TsdfVoxel, common::VoxelBlock::kVoxels> voxels;  ///< In the order of common::VoxelBlock.
};

/// Frames are drawn at their final poses, with all loop closures. One thread. The same frames in the same order give
/// the same bits.
class TsdfVolume {
 public:
  explicit TsdfVolume(const TsdfConfig& config);

  /// Colour and depth must have the size of the frame's camera.
  void integrate(const common::RgbdFrame& frame, const common::Pose3& T_map_camera);

  double resolution_m() const { return config_.resolution_m; }
  /// Surfaces are drawn up to here: up to range_max_m, and less where the noise of a depth exceeds two voxels.
  double range_m() const { return range_m_; }
  /// In ascending order.
  std::vector<common::VoxelIndex> blocks() const;
  /// Null where nothing was seen.
  const TsdfBlock* block(common::VoxelIndex index) const;
  /// Whether a surface was left out for lack of blocks.
  bool isFull() const { return is_full_; }

 private:
  /// Makes the blocks that the truncated distance of the frame's surfaces reaches.
  void makeBlocks(const common::RgbdFrame& frame, const common::Pose3& T_map_camera);
  void makeBlocksAlong(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m);

  TsdfConfig config_;
  double range_m_;
  bool is_full_ = false;
  std::unordered_map<common::VoxelIndex, std::unique_ptr<TsdfBlock>, common::VoxelMap::Hash> blocks_;
};

}  // namespace swiftlet::mapping3d
