// Descriptor of a patch: how often each orientation of the gradient occurs in it (W. Freeman, M. Roth, "Orientation
// histograms for hand gesture recognition", MERL TR-94-03, 1995, section 3), which Tomic 2012 uses for its patches.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// Bins of 10 degrees over the whole turn, as published.
inline constexpr std::size_t kOrientationBins = 36;

struct OrientationHistogram {
  /// Smoothed around the circle, mean 0, norm 1: the dot product of two is their normalized cross-correlation.
  std::array<float, kOrientationBins> bins{};
  int turn_bins = 0;  ///< By how many bins it was turned, so that the most frequent orientation comes first.
};

float correlation(const OrientationHistogram& a, const OrientationHistogram& b);

/// Of the square patch around a pixel. None if it leaves the image or has too few gradients.
std::optional<OrientationHistogram> orientationHistogram(const vision::GrayImage& image, int u_px, int v_px);

}  // namespace swiftlet::perception
