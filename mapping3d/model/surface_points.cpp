#include "mapping3d/model/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

namespace swiftlet::mapping3d {
namespace {

using Eigen::Vector3f;

/// The normal comes from the pixels this far to each side: over fewer the noise of the depth turns it too much.
constexpr int kReach_px = 3;
/// Neighbours belong to the same surface within kSigmas standard deviations, and kSteepest times their distance: a
/// slope of 75 degrees. The same as in surface_fit.cpp.
constexpr float kSigmas = 4.0F;
constexpr float kSteepest = 3.7F;
/// A surface seen at a smaller angle has no reliable depth: the sine of 10 degrees.
constexpr float kLeastCosine = 0.17F;

class FrameSurface {
 public:
  FrameSurface(const common::RgbdFrame& frame, const vision::DepthNoiseConfig& noise) : frame_(frame), noise_(noise) {}

  std::optional<SeenPoint> at(int u, int v) const {
    const float depth_m = frame_.depth.at(u, v);
    const auto sigma_m = static_cast<float>(noise_.sigma_m(static_cast<double>(depth_m)));
    const float gate_m = kSigmas * sigma_m + kSteepest * kReach_px * depth_m / static_cast<float>(frame_.camera.fx_px);
    const auto left = neighbour(u - kReach_px, v, depth_m, gate_m),
               right = neighbour(u + kReach_px, v, depth_m, gate_m);
    const auto above = neighbour(u, v - kReach_px, depth_m, gate_m),
               below = neighbour(u, v + kReach_px, depth_m, gate_m);
    if (!left || !right || !above || !below) return std::nullopt;
    SeenPoint point;
    point.position_m = pointAt(u, v, depth_m);
    // Left is +y and up is +z: their product points back to the camera.
    point.normal = (*above - *below).cross(*left - *right).normalized();
    if (point.normal.dot(point.position_m) > 0.0F) point.normal = -point.normal;
    if (-point.normal.dot(point.position_m) < kLeastCosine * point.position_m.norm()) return std::nullopt;
    const auto pixel = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(frame_.camera.width_px) +
                            static_cast<std::size_t>(u));
    std::copy_n(frame_.color.rgb.begin() + static_cast<std::ptrdiff_t>(pixel), 3, point.rgb.begin());
    point.weight = 1.0F / (sigma_m * sigma_m);
    return point;
  }

 private:
  Vector3f pointAt(int u, int v, float depth_m) const {
    return frame_.camera.point_camera_m(u, v, static_cast<double>(depth_m)).cast<float>();
  }
  std::optional<Vector3f> neighbour(int u, int v, float depth_m, float gate_m) const {
    const float there_m = frame_.depth.at(u, v);
    if (!noise_.isUsable(there_m) || std::abs(there_m - depth_m) > gate_m) return std::nullopt;
    return pointAt(u, v, there_m);
  }

  const common::RgbdFrame& frame_;
  const vision::DepthNoiseConfig& noise_;
};

}  // namespace

std::vector<SeenPoint> surfacePoints(const common::RgbdFrame& frame, int pixel_step, double range_m,
                                     const vision::DepthNoiseConfig& noise) {
  const FrameSurface surface(frame, noise);
  std::vector<SeenPoint> points;
  for (int v = kReach_px; v < frame.camera.height_px - kReach_px; v += pixel_step)
    for (int u = kReach_px; u < frame.camera.width_px - kReach_px; u += pixel_step) {
      const float depth_m = frame.depth.at(u, v);
      if (!noise.isUsable(depth_m) || static_cast<double>(depth_m) > range_m) continue;
      if (const auto point = surface.at(u, v)) points.push_back(*point);
    }
  return points;
}

}  // namespace swiftlet::mapping3d
