// A frame at several resolutions, the finest first.
#pragma once

#include <vector>

#include "common/rgbd_frame.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::mapping3d {

struct PyramidLevel {
  common::PinholeCamera camera;
  vision::GrayImage gray;
  common::DepthImage depth;
};

using FramePyramid = std::vector<PyramidLevel>;

/// The finest level is at most 320 pixels wide; each further one has half the resolution, `levels` in all, or
/// fewer if the picture is too small. The frame's colour and depth must have the size of its camera.
FramePyramid makePyramid(const common::RgbdFrame& frame, int levels = 4);

}  // namespace swiftlet::mapping3d
