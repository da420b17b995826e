// Grey images, and colour and depth images at half the resolution. Integer arithmetic, or floats in a fixed order:
// equal input gives equal bytes on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "common/rgbd_frame.hpp"

namespace swiftlet::vision {

/// An 8-bit picture, row by row from the top left.
struct GrayImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> values;

  int at(int u_px, int v_px) const { return row(v_px)[u_px]; }
  const std::uint8_t* row(int v_px) const {
    return values.data() + static_cast<std::ptrdiff_t>(v_px) * static_cast<std::ptrdiff_t>(width_px);
  }
};

/// The luma of Rec. 601.
GrayImage grayOf(const common::Image& image);

/// Half the width and height, rounded down; each pixel is the mean of four.
GrayImage halved(const GrayImage& image);

/// Each pixel is the mean of those of its four that belong to the nearest surface among them, so that no point appears
/// between two surfaces. With fewer than two measured pixels it is unknown: a sensor errs most beside a hole.
common::DepthImage halved(const common::DepthImage& depth);

/// The camera of the halved image. A pixel's centre has integer coordinates, so the principal point moves by a quarter
/// of a new pixel as well.
common::PinholeCamera halved(const common::PinholeCamera& camera);

/// Variance, in squared grey levels per squared pixel, of the gradients that the noise of the picture alone gives
/// between interpolated pixels (J. Immerkaer, "Fast noise variance estimation", CVIU 1996). 0 for a picture of less
/// than 3 x 3.
double gradientNoiseVariance(const GrayImage& gray);

}  // namespace swiftlet::vision
