// The voxels that the rays of a depth image cross, found from the voxels' side.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/voxel_map.hpp"
#include "mapping3d/voxels/depth_pyramid.hpp"
#include "mapping3d/voxels/pixel_groups.hpp"
#include "mapping3d/voxels/scan_window.hpp"

namespace swiftlet::mapping3d {

/// A depth image has many more rays than it has voxels in its view, so cubes of voxels are projected into the image
/// instead of walking along each ray, from coarse to fine, as wavemap does (Reijgwart et al. 2023, section IV). A cube
/// is decided as a whole where all rays that may meet it end beyond it (each voxel is crossed) or before it (none is).
/// Where cubes of 4 x 4 x 4 voxels are not, a voxel counts as crossed if the deepest ray through a square in its
/// middle, about as wide as the voxel, goes on beyond it. Rays that only touch a corner of a voxel may be missed, and
/// pixels are looked at in groups where a voxel spans several: tests compare the result with that of walking along each
/// ray. One thread.
class DepthCarving {
 public:
  DepthCarving(double range_max_m, double resolution_m);

  /// Marks all voxels that are crossed. `free_m` holds for each pixel the depth up to which its ray is free; 0 where
  /// nothing is known. The window must be around the camera. The voxels are those of the frame `map`.
  void carve(const std::vector<float>& free_m, const common::PinholeCamera& camera, const common::Pose3& T_map_camera,
             ScanWindow& window);

 private:
  /// Groups of the image; empty: last < first.
  struct Rectangle {
    int u_first, v_first, u_last, v_last;
    bool cut = false;  ///< Whether parts of it lie outside the image.
    bool empty() const { return u_last < u_first || v_last < v_first; }
  };
  enum class Crossed { kNone, kSome, kAll };

  void follow(const common::PinholeCamera& camera, const common::Pose3& T_map_camera);
  void carveNear(ScanWindow& window) const;
  void carveBlock(const Eigen::Vector3f& center_camera_m, VoxelBits& crossed) const;
  void carveVoxels(int offset, const Eigen::Vector3f& center_camera_m, VoxelBits& crossed) const;
  Crossed cubeCrossed(int side, const Eigen::Vector3f& center_camera_m) const;
  Rectangle groupsOf(int side, const Eigen::Vector3f& center_camera_m) const;

  double range_max_m_;
  double resolution_m_;
  float near_m_;  ///< Nearer voxels are found by walking along rays, as they may surround the camera.

  // Of the present image:
  common::PinholeCamera camera_;
  PixelGroups groups_;
  Eigen::Vector3d origin_map_m_;
  Eigen::Matrix3d rotation_map_camera_;
  Eigen::Matrix3f rotation_camera_map_;
  Eigen::Vector3f half_extent_m_;  ///< Half of the extent of a voxel along the axes of the camera.
  /// Divided by the depth: how far beside the outermost rays a voxel may lie, in groups.
  Eigen::Array2f beside_first_m_, beside_last_m_;
  DepthPyramid deepest_;  ///< Of the depths up to which rays are free.
  DepthPyramid shallowest_;
};

}  // namespace swiftlet::mapping3d
