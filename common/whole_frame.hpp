// Whether pictures have as many pixels as they say. What reads or encodes them relies on it.
#pragma once

#include <cstddef>

#include "common/image.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::common {

inline bool isWhole(const Image& image) {
  return image.width_px > 0 && image.height_px > 0 &&
         image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
}

inline bool isWhole(const DepthImage& depth) {
  return depth.width_px > 0 && depth.height_px > 0 &&
         depth.depth_m.size() == static_cast<std::size_t>(depth.width_px) * static_cast<std::size_t>(depth.height_px);
}

/// Whether the images have the size of the camera as well.
inline bool isWhole(const RgbdFrame& frame) {
  const auto sizeIsOf = [&](const auto& image) {
    return image.width_px == frame.camera.width_px && image.height_px == frame.camera.height_px;
  };
  return frame.camera.fx_px > 0.0 && frame.camera.fy_px > 0.0 && isWhole(frame.color) && isWhole(frame.depth) &&
         sizeIsOf(frame.color) && sizeIsOf(frame.depth);
}

/// Whether both pictures of a stereo camera are there and have its size.
inline bool isWholePair(const RgbdFrame& frame) {
  const auto isPicture = [&](const Image& image) {
    return isWhole(image) && image.width_px == frame.camera.width_px && image.height_px == frame.camera.height_px;
  };
  return frame.camera.fx_px > 0.0 && frame.camera.fy_px > 0.0 && isPicture(frame.color) && frame.right &&
         isPicture(*frame.right);
}

}  // namespace swiftlet::common
