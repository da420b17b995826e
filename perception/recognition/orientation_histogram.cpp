#include "perception/recognition/orientation_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swiftlet::perception {
namespace {

/// Half the side of a patch.
constexpr int kHalfPatch_px = 8;
/// Doubled gradients below are noise (Freeman and Roth: "a contrast threshold").
constexpr int kLeastContrast = 16;
/// Pixels of a patch with a gradient, at least.
constexpr int kLeastPixels = 12;

}  // namespace

float correlation(const OrientationHistogram& a, const OrientationHistogram& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < kOrientationBins; ++i) sum += a.bins[i] * b.bins[i];
  return sum;
}

std::optional<OrientationHistogram> orientationHistogram(const vision::GrayImage& image, int u_px, int v_px) {
  constexpr int kReach = kHalfPatch_px + 1;
  if (u_px < kReach || v_px < kReach || u_px + kReach >= image.width_px || v_px + kReach >= image.height_px)
    return std::nullopt;
  std::array<float, kOrientationBins> counts{};
  int pixels = 0;
  for (int v = v_px - kHalfPatch_px; v <= v_px + kHalfPatch_px; ++v)
    for (int u = u_px - kHalfPatch_px; u <= u_px + kHalfPatch_px; ++u) {
      const int du = image.at(u + 1, v) - image.at(u - 1, v), dv = image.at(u, v + 1) - image.at(u, v - 1);
      if (du * du + dv * dv < kLeastContrast * kLeastContrast) continue;
      const double share = std::atan2(static_cast<double>(dv), static_cast<double>(du)) / (2.0 * std::numbers::pi);
      const int bin =
          static_cast<int>(std::floor((share + 1.0) * kOrientationBins)) % static_cast<int>(kOrientationBins);
      counts[static_cast<std::size_t>(bin)] += 1.0F;
      ++pixels;
    }
  if (pixels < kLeastPixels) return std::nullopt;
  // The filter of Freeman and Roth, section 3: [1 4 6 4 1] around the circle.
  std::array<float, kOrientationBins> smooth{};
  constexpr std::array<float, 5> kFilter = {1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
  for (std::size_t i = 0; i < kOrientationBins; ++i)
    for (std::size_t k = 0; k < kFilter.size(); ++k)
      smooth[i] += kFilter[k] * counts[(i + k + kOrientationBins - 2) % kOrientationBins];
  const auto first = static_cast<std::size_t>(std::max_element(smooth.begin(), smooth.end()) - smooth.begin());
  const float mean = static_cast<float>(pixels) / static_cast<float>(kOrientationBins);
  float squares = 0.0F;
  for (const float value : smooth) squares += (value - mean) * (value - mean);
  if (!(squares > 0.0F)) return std::nullopt;
  OrientationHistogram histogram;
  histogram.turn_bins = static_cast<int>(first);
  for (std::size_t i = 0; i < kOrientationBins; ++i)
    histogram.bins[i] = (smooth[(i + first) % kOrientationBins] - mean) / std::sqrt(squares);
  return histogram;
}

}  // namespace swiftlet::perception
