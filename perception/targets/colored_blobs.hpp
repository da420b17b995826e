// Connected pieces of one colour in an RGB-D frame.
#pragma once

#include <cstdint>
#include <vector>

#include "common/rgbd_frame.hpp"
#include "perception/targets/color_classes.hpp"

namespace swiftlet::perception {

/// Pixels of one class that touch and whose depths are near to each other.
struct ColoredBlob {
  std::uint8_t color = 0;   ///< Index of its class.
  std::vector<int> pixels;  ///< Row by row from the top left; each has a measured depth.
  int left = 0, right = 0;  ///< Columns of the rectangle around the blob, both included.
  int top = 0, bottom = 0;  ///< Rows of the rectangle around the blob.
};

/// The blobs of at least `pixels_min` pixels, in the order of their first pixels. Two targets of one colour, one of
/// them behind the other in the picture, are two blobs. The frame's images must have the size of its camera.
std::vector<ColoredBlob> coloredBlobs(const common::RgbdFrame& frame, const ColorClasses& classes, int pixels_min);

}  // namespace swiftlet::perception
