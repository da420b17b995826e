// Corners of Shi and Tomasi, "Good features to track", CVPR 1994: places where the picture changes along every
// direction.
//
// The score is the smaller eigenvalue of the gradients' second moments over a window. It is computed by sums of
// integers and one correctly rounded square root, so it does not depend on the instruction set of the CPU.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vision/gray_image.hpp"

namespace swiftlet::vision {

struct CornerConfig {
  int greatest_number = 400;  ///< Corners of a picture, at most.
  int cell_px = 16;           ///< Side of the cells over which corners are spread.
};

struct Corner {
  Eigen::Vector2d pixel;  ///< Refined to a fraction of a pixel.
  double contrast = 0.0;  ///< Root mean square of the gradient along the weakest direction, in grey levels per pixel.
};

/// The contrast of each pixel, row by row; 0 near the border.
std::vector<float> cornerContrast(const GrayImage& image);

/// Local maxima of the contrast. The picture is divided into cells; the strongest corner of every cell comes first,
/// then the second of every cell, until there are enough, so that one richly textured poster does not take them all.
/// Ordered so; of equal corners the upper left one comes first.
std::vector<Corner> findCorners(const GrayImage& image, const CornerConfig& config);

}  // namespace swiftlet::vision
