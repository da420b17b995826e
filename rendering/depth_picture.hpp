// A depth image in colours.
#pragma once

#include "common/image.hpp"
#include "common/rgbd_frame.hpp"
#include "rendering/color.hpp"

namespace swiftlet::rendering {

/// The depths that get the first and the last colour: what RGB-D cameras of the kind of Kinect and Xtion measure.
inline constexpr double kNearestDepthShown_m = 0.4;
inline constexpr double kFarthestDepthShown_m = 5.0;

/// Red is near, then yellow, green, cyan; blue is far. With x from 0 (far) to 1 (near), each channel is
/// s(clamp(1.5 - |4 x - c|, 0, 1)), where s(t) = t^2 (3 - 2 t) and c is 3 for red, 2 for green and 1 for blue.
Color depthColor(double depth_m);
inline constexpr Color kUnknownDepth = rgb(0x6b7280);  ///< Grey: nothing was measured.
inline constexpr Color kTooFarDepth = rgb(0x10131a);   ///< Nearly black: free as far as the camera sees.

/// At most `width_px` wide, with the aspect ratio of the image. A smaller image keeps its size. Depths are not mixed:
/// each pixel shows one of the image. A scale of the colours is at the bottom. The image has at least one pixel.
common::Image depthPicture(const common::DepthImage& depth, int width_px);

}  // namespace swiftlet::rendering
