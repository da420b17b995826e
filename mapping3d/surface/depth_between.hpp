// The depth of a surface between the pixels of a depth image.
#pragma once

#include "common/rgbd_frame.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

/// The depth at (u_px, v_px), from the four pixels around. DepthImage::kUnknown where one of them was not measured or
/// where they do not lie on one surface: a pixel at an edge often has a depth between those of the two surfaces.
/// kTooFar where all four are so. The image must have the size of `camera`; outside of it nothing is known.
float depthBetween(const common::DepthImage& depth, const common::PinholeCamera& camera,
                   const vision::DepthNoiseConfig& noise, float u_px, float v_px);

}  // namespace swiftlet::mapping3d
