// The voxels in which the rays of a depth image end.
#pragma once

#include <array>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// Computes them for many pixels at once, in single precision relative to a voxel near the camera. A pure function of
/// its arguments.
class DepthEnds {
 public:
  /// Number of pixels of a row that are processed together.
  static constexpr int kChunk = 64;
  /// For each pixel the numbers of the voxel, counted from the first one; kUnknown or kTooFar in `x` where the ray has
  /// no end within the range.
  struct Chunk {
    static constexpr int kUnknown = -1, kTooFar = -2;
    std::array<int, kChunk> x, y, z;
  };

  /// No number of a voxel within the range may be below that of `first`.
  DepthEnds(const common::PinholeCamera& camera, const common::Pose3& T_map_camera, common::VoxelIndex first,
            double resolution_m);

  /// Of the `count` pixels from (u, v) on, whose depths and greatest depths are given. Writes the depths up to which
  /// their rays are free, 0 where nothing is known.
  void find(int u, int v, int count, const float* depth_m, const float* range_depth_m, float* free_m,
            Chunk& chunk) const;

 private:
  Eigen::Vector3f origin_;         ///< In voxels, from the corner of the first.
  Eigen::Vector3f ray_;            ///< Of pixel (0, 0), in voxels per metre of depth.
  Eigen::Vector3f per_u_, per_v_;  ///< What a pixel further to the right, or down, adds to it.
};

}  // namespace swiftlet::mapping3d
