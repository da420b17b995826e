#include "vision/gray_image.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace swiftlet::vision {
namespace {

/// Depths within this part of the nearest one belong to its surface: steeper surfaces are seen too obliquely to
/// measure.
constexpr float kSameSurface = 0.03F;

float nearestSurface_m(const std::array<float, 4>& depths_m) {
  float nearest_m = common::DepthImage::kTooFar;
  int measured = 0;
  for (const float depth_m : depths_m) {
    if (!common::isMeasured(depth_m)) continue;
    ++measured;
    nearest_m = std::min(nearest_m, depth_m);
  }
  if (measured == 0)
    return std::find(depths_m.begin(), depths_m.end(), common::DepthImage::kTooFar) != depths_m.end()
               ? common::DepthImage::kTooFar
               : common::DepthImage::kUnknown;
  if (measured == 1) return common::DepthImage::kUnknown;
  float sum_m = 0.0F;
  int count = 0;
  for (const float depth_m : depths_m) {
    if (!common::isMeasured(depth_m) || depth_m > nearest_m * (1.0F + kSameSurface)) continue;
    sum_m += depth_m;
    ++count;
  }
  return sum_m / static_cast<float>(count);
}

}  // namespace

GrayImage grayOf(const common::Image& image) {
  GrayImage gray{image.width_px, image.height_px, {}};
  gray.values.resize(image.rgb.size() / 3);
  const std::uint8_t* rgb = image.rgb.data();
  for (std::uint8_t& value : gray.values) {
    value = static_cast<std::uint8_t>((77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) >> 8);
    rgb += 3;
  }
  return gray;
}

GrayImage halved(const GrayImage& image) {
  GrayImage half{image.width_px / 2, image.height_px / 2, {}};
  half.values.resize(static_cast<std::size_t>(half.width_px) * static_cast<std::size_t>(half.height_px));
  std::uint8_t* out = half.values.data();
  for (int v = 0; v < half.height_px; ++v) {
    const std::uint8_t *upper = image.row(2 * v), *lower = image.row(2 * v + 1);
    for (int u = 0; u < half.width_px; ++u, upper += 2, lower += 2)
      *out++ = static_cast<std::uint8_t>((upper[0] + upper[1] + lower[0] + lower[1] + 2) >> 2);
  }
  return half;
}

common::DepthImage halved(const common::DepthImage& depth) {
  common::DepthImage half{depth.width_px / 2, depth.height_px / 2, {}};
  half.depth_m.reserve(static_cast<std::size_t>(half.width_px) * static_cast<std::size_t>(half.height_px));
  for (int v = 0; v < half.height_px; ++v)
    for (int u = 0; u < half.width_px; ++u)
      half.depth_m.push_back(nearestSurface_m({depth.at(2 * u, 2 * v), depth.at(2 * u + 1, 2 * v),
                                               depth.at(2 * u, 2 * v + 1), depth.at(2 * u + 1, 2 * v + 1)}));
  return half;
}

common::PinholeCamera halved(const common::PinholeCamera& camera) {
  return {camera.width_px / 2, camera.height_px / 2,       0.5 * camera.fx_px,
          0.5 * camera.fy_px,  0.5 * (camera.cx_px - 0.5), 0.5 * (camera.cy_px - 0.5)};
}

/// Noise by second differences, which pass over even slopes, of the quarter of the picture with the least texture. A
/// gradient is the difference of two pixels, each the mean of two beside each other: 4/3 on average.
double gradientNoiseVariance(const GrayImage& gray) {
  constexpr int kStep_px = 3;
  constexpr double kQuarter = 0.3186, kMask = 6.0;  // Of a Gaussian's absolute values; the norm of the mask.
  std::vector<int> curvatures;
  for (int v = 1; v < gray.height_px - 1; v += kStep_px) {
    const std::uint8_t *above = gray.row(v - 1), *here = gray.row(v), *below = gray.row(v + 1);
    for (int u = 1; u < gray.width_px - 1; u += kStep_px)
      curvatures.push_back(std::abs(above[u - 1] + above[u + 1] + below[u - 1] + below[u + 1] + 4 * here[u] -
                                    2 * (above[u] + below[u] + here[u - 1] + here[u + 1])));
  }
  if (curvatures.empty()) return 0.0;
  const auto quarter = curvatures.begin() + static_cast<std::ptrdiff_t>(curvatures.size() / 4);
  std::nth_element(curvatures.begin(), quarter, curvatures.end());
  const double sigma = *quarter / (kQuarter * kMask);
  return 4.0 / 3.0 * sigma * sigma;
}

}  // namespace swiftlet::vision
