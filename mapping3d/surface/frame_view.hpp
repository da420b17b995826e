// Which blocks of voxels a depth image can say something about.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

/// Blocks are cubes, whose middles are given in the frame `camera`. It may say yes of a block that no pixel changes,
/// but never no of one that some pixel does.
class FrameView {
 public:
  /// `half_side_m` is half the side of a block. Surfaces count up to `range_m`; up to `behind_m` behind one, along the
  /// view, a block is changed.
  FrameView(const common::RgbdFrame& frame, double half_side_m, double range_m, double behind_m);

  bool sees(const Eigen::Vector3f& middle_camera_m) const;

 private:
  /// Of the pixels that the block may cover.
  float farthestDepth_m(const Eigen::Vector3f& middle_camera_m) const;

  common::PinholeCamera camera_;
  float radius_m_, range_m_, behind_m_;
  std::array<Eigen::Vector3f, 4> sides_;  ///< Normals of the sides of the view, inwards.
  int columns_, rows_;
  std::vector<float> tiles_m_;  ///< The farthest depth in each tile of the image, at most the range; 0 without any.
};

}  // namespace swiftlet::mapping3d
