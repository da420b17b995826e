// Whether a rectified pair fits its calibration: a corner lies in the same row of both pictures, and in the right one
// farther to the left. Cameras that have moved against each other, other lenses, and exchanged pictures show here.
#pragma once

#include <optional>

#include "common/message.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::vision {

/// What the corners that are alike in both pictures are apart.
struct EpipolarResidual {
  int pairs = 0;
  double rows_px = 0.0;         ///< Median of the absolute difference of the rows.
  double share_reversed = 0.0;  ///< Of the pairs whose right corner lies farther to the right.
};

/// None with too few corners that are alike.
std::optional<EpipolarResidual> epipolarResidual(const GrayImage& left, const GrayImage& right);

/// Why the pair does not fit; none if it does.
std::optional<common::Message> contradictionOf(const EpipolarResidual& residual);

}  // namespace swiftlet::vision
