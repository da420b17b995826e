// Colour and depth that were not taken at the same time: many cameras expose them up to half a frame apart. While the
// camera turns, the depth then lies beside what the colour shows (at 50 deg/s and 15 ms by three quarters of a degree).
#pragma once

#include "common/geometry.hpp"
#include "mapping3d/odometry/frame_pyramid.hpp"

namespace swiftlet::mapping3d {

/// The depths of a frame as they are seen from where its colour was taken; `T_color_depth` is the motion between the
/// two. Exact on surfaces; beside an edge a pixel may have the depth of its neighbour.
common::DepthImage depthFrom(const common::DepthImage& depth, const common::PinholeCamera& camera,
                             const common::Pose3& T_color_depth);

/// The same in all levels of a pyramid.
void moveDepth(FramePyramid& pyramid, const common::Pose3& T_color_depth);

}  // namespace swiftlet::mapping3d
