#include "mapping3d/surface/depth_between.hpp"

#include <algorithm>
#include <cmath>

#include "common/row_major.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Neighbours belong to one surface within kOneSurfaceSigmas standard deviations, and kSteepestSurface times their
/// distance: a slope of 75 degrees. The same as in surface_points.cpp.
constexpr float kOneSurfaceSigmas = 4.0F;
constexpr float kSteepestSurface = 3.7F;
/// From corner to corner of a pixel.
constexpr float kDiagonal = 1.42F;

}  // namespace

float depthBetween(const common::DepthImage& depth, const common::PinholeCamera& camera,
                   const vision::DepthNoiseConfig& noise, float u_px, float v_px) {
  using common::DepthImage;
  if (!(u_px >= 0.0F && v_px >= 0.0F)) return DepthImage::kUnknown;
  const float left = std::floor(u_px), top = std::floor(v_px);
  if (left + 1.0F >= static_cast<float>(depth.width_px) || top + 1.0F >= static_cast<float>(depth.height_px))
    return DepthImage::kUnknown;
  const float* row =
      depth.depth_m.data() + common::rowMajor(static_cast<int>(top), depth.width_px, static_cast<int>(left));
  const float* below = row + depth.width_px;
  const auto [least, greatest] = std::minmax({row[0], row[1], below[0], below[1]});
  if (least == DepthImage::kUnknown || !std::isfinite(greatest))
    return least == DepthImage::kTooFar ? DepthImage::kTooFar : DepthImage::kUnknown;
  const auto sigma_m = static_cast<float>(noise.sigma_m(static_cast<double>(least)));
  const float step_m = kDiagonal * least / static_cast<float>(camera.fx_px);
  if (greatest - least > kOneSurfaceSigmas * sigma_m + kSteepestSurface * step_m) return DepthImage::kUnknown;
  const float across = u_px - left, down = v_px - top;
  const float upper = row[0] + across * (row[1] - row[0]), lower = below[0] + across * (below[1] - below[0]);
  return upper + down * (lower - upper);
}

}  // namespace swiftlet::mapping3d
