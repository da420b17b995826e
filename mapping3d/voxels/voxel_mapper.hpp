// Draws depth images and laser beams into a voxel map.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/disc.hpp"
#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/voxel_map.hpp"
#include "mapping3d/voxels/depth_carving.hpp"
#include "mapping3d/voxels/depth_ends.hpp"
#include "mapping3d/voxels/scan_window.hpp"
#include "mapping3d/voxels/voxel_config.hpp"

namespace swiftlet::mapping3d {

/// A beam that has returned: from the sensor to the surface.
struct Ray {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d end_m;
};

/// What one frame changed.
struct InsertionCounts {
  int hits = 0;       ///< Rays that ended on a surface within range.
  int too_far = 0;    ///< Rays without a surface within range: free up to the range.
  int unknown = 0;    ///< Pixels about which nothing is known.
  int ignored = 0;    ///< Rays that ended on a person.
  int forgotten = 0;  ///< Blocks that were removed because the map was full.
};

/// Holds the map and draws into it. All rays of a frame together change each voxel once: voxels in which one of them
/// ends gain log odds, others that they cross lose some (Hornung et al. 2013, section 4.1). The voxels are those that
/// OctoMap's insertPointCloud finds for the same points. One thread; not const.
class VoxelMapper {
 public:
  explicit VoxelMapper(const VoxelConfig& config);
  /// Draws on into a map of the same resolution; a snapshot(), whose blocks are cloned before they are written.
  VoxelMapper(const VoxelConfig& config, const common::VoxelMap& map);

  /// The depth image must have the size of `camera`. Rays that end within one of the discs (a person, at any height)
  /// only clear the space before it.
  InsertionCounts insert(const common::DepthImage& depth, const common::PinholeCamera& camera,
                         const common::Pose3& T_map_camera, std::span<const common::Disc> people = {});
  /// Rays in the frame of the map, as one frame. Those that end beyond the range, or on a person, only clear the space
  /// before that. A ray whose origin is more than a block from that of the first is unknown: one sweep is not so long.
  InsertionCounts insert(std::span<const Ray> rays_map, std::span<const common::Disc> people = {});

  const common::VoxelMap& map() const { return map_; }
  common::VoxelMap snapshot() { return map_.snapshot(); }

 private:
  void followCamera(const common::PinholeCamera& camera);
  void addRay(const Eigen::Vector3d& origin_map_m, const Eigen::Vector3d& end_map_m, bool hit);
  void mark(const DepthEnds::Chunk& chunk, int count, InsertionCounts& counts);
  void markHit(common::VoxelIndex voxel);
  void apply();
  void applyTo(common::VoxelBlock& block, const SeenBlock& seen) const;
  int forgetFarBlocks(const Eigen::Vector3d& origin_map_m);

  VoxelConfig config_;
  int least_;  ///< In steps of VoxelMap::kLogOddsStep.
  common::VoxelMap map_;
  ScanWindow window_;
  DepthCarving carving_;
  common::PinholeCamera camera_;       ///< Camera of the last image.
  std::vector<float> range_depths_m_;  ///< For each pixel of that camera, the depth at the end of the range.
  std::vector<float> free_m_;          ///< For each pixel of the present image, the depth up to which its ray is free.
};

}  // namespace swiftlet::mapping3d
