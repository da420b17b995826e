// A picture at the full, half, quarter ... resolution, and how it is read between its pixels.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// The value between four pixels. The place must be inside: 0 <= u < width - 1, 0 <= v < height - 1.
inline float interpolated(const vision::GrayImage& image, float u, float v) {
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const float right_share = u - static_cast<float>(left), lower_share = v - static_cast<float>(top);
  const std::uint8_t* const upper = image.row(top) + left;
  const std::uint8_t* const lower = upper + image.width_px;
  const float above = static_cast<float>(upper[0]) + right_share * static_cast<float>(upper[1] - upper[0]);
  const float below = static_cast<float>(lower[0]) + right_share * static_cast<float>(lower[1] - lower[0]);
  return above + lower_share * (below - above);
}

/// Whether a place is at least `margin_px` away from the border, so that it and its neighbours can be read.
inline bool isInside(const vision::GrayImage& image, double u, double v, double margin_px) {
  return u >= margin_px && v >= margin_px && u < image.width_px - 1 - margin_px && v < image.height_px - 1 - margin_px;
}

/// A pixel of level 0 as it is in level `level`: the centres of pixels have integer coordinates.
inline Eigen::Vector2d atLevel(const Eigen::Vector2d& pixel, int level) {
  const double scale = 1.0 / static_cast<double>(1 << level);
  return {(pixel.x() + 0.5) * scale - 0.5, (pixel.y() + 0.5) * scale - 0.5};
}

/// Halved as long as the shorter side keeps `least_side_px`; level 0 is the picture itself, at any size.
std::vector<vision::GrayImage> pyramidOf(const vision::GrayImage& picture, int least_side_px);

}  // namespace swiftlet::perception
