#include "simulation/sensors/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"
#include "common/row_major.hpp"
#include "simulation/sensors/pixel_noise.hpp"

namespace swiftlet::simulation {
namespace {

constexpr float kUnknown = common::DepthImage::kUnknown;

/// The returned power goes with reflectance * cos(incidence) / range^2.
float seenSquared_m2(double dark_range_m) {
  constexpr double kBlack = 0.04;  // Reflectance of black surfaces in the near infrared.
  if (dark_range_m <= 0.0) return std::numeric_limits<float>::infinity();
  return static_cast<float>(dark_range_m * dark_range_m / kBlack);
}

}  // namespace

DepthSensor::DepthSensor(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, std::uint64_t seed)
    : config_(config),
      errors_(errors),
      seed_(seed),
      seen_m2_(seenSquared_m2(errors.dark_range_m)),
      least_cos_(static_cast<float>(std::cos(errors.glancing_deg * common::kRadPerDeg))) {}

common::DepthImage DepthSensor::measure(std::uint64_t number, const SeenImage& seen) const {
  common::DepthImage image{seen.width_px, seen.height_px, seen.depth_m};
  addNoise(number, image.depth_m);
  for (std::size_t i = 0; i < image.depth_m.size(); ++i)
    if (seen.is_weak[i] != 0 || !std::isfinite(seen.depth_m[i])) image.depth_m[i] = kUnknown;
  if (config_.baseline_m > 0.0) dropShadows(seen, image.depth_m);
  if (errors_.edge_hole_rate > 0.0) dropEdges(number, seen, image.depth_m);
  return image;
}

// A surface seen at column u is at u - f b / z in the projector's view. The projector sees it unless something nearer,
// which the camera sees farther to the right, is at the same place or to the left of it in that view.
void DepthSensor::dropShadows(const SeenImage& seen, std::vector<float>& depth_m) const {
  const auto disparity_px_m = static_cast<float>(config_.camera().fx_px * config_.baseline_m);
  for (int v = 0; v < seen.height_px; ++v) {
    const std::size_t row = common::rowMajor(v, seen.width_px, 0);
    float leftmost_px = std::numeric_limits<float>::infinity();
    for (int u = seen.width_px - 1; u >= 0; --u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      const float projected_px = static_cast<float>(u) - disparity_px_m / seen.depth_m[pixel];
      if (projected_px >= leftmost_px) depth_m[pixel] = kUnknown;
      leftmost_px = std::min(leftmost_px, projected_px);
    }
  }
}

void DepthSensor::dropEdges(std::uint64_t number, const SeenImage& seen, std::vector<float>& depth_m) const {
  constexpr float kEdge_m = 0.10F;  // A slanted surface changes by less from one pixel to the next.
  common::RandomStream random(seed_, "rgbd edge", number);
  const auto width = static_cast<std::size_t>(seen.width_px);
  const auto compare = [&](std::size_t pixel, std::size_t neighbour) {
    const float step_m = seen.depth_m[pixel] - seen.depth_m[neighbour];
    if (!(std::abs(step_m) > kEdge_m) || !random.chance(errors_.edge_hole_rate)) return;
    depth_m[step_m > 0.0F ? pixel : neighbour] = kUnknown;
  };
  for (std::size_t pixel = 0; pixel < depth_m.size(); ++pixel) {
    if (pixel % width > 0) compare(pixel, pixel - 1);
    if (pixel >= width) compare(pixel, pixel - width);
  }
}

void DepthSensor::addNoise(std::uint64_t number, std::vector<float>& depth_m) const {
  PixelNoise noise(config_.inverse_depth_noise_1_m, common::RandomStream(seed_, "rgbd depth", number));
  const auto bias_1_m = static_cast<float>(errors_.inverse_depth_bias_1_m);
  const auto step_1_m = static_cast<float>(config_.inverse_depth_step_1_m);
  const auto step_m = static_cast<float>(config_.depth_step_m);
  const auto range_min_m = static_cast<float>(config_.range_min_m),
             range_max_m = static_cast<float>(config_.range_max_m);
  // Small enough for an int whatever the steps are.
  constexpr float kMost = 1e8F;
  const auto rounded = [](float value, float step) {
    const float count = value / step;
    return step > 0.0F && count < kMost ? step * static_cast<float>(std::lround(count)) : value;
  };
  for (float& depth : depth_m) {
    const float inverse_1_m = rounded(std::max(0.0F, 1.0F / depth + bias_1_m + noise.next()), step_1_m);
    const float measured_m = rounded(1.0F / inverse_1_m, step_m);
    depth = measured_m < range_min_m ? kUnknown : measured_m > range_max_m ? common::DepthImage::kTooFar : measured_m;
  }
}

}  // namespace swiftlet::simulation
