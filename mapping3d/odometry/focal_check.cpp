#include "mapping3d/odometry/focal_check.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace swiftlet::mapping3d {
namespace {

/// Fewer pairs of views are no evidence.
constexpr int kLeastAdded = 3;
/// With a right focal length another one leaves at least 0.95 of what it leaves, on recordings
/// (docs/decisions/mapping3d.md#041).
constexpr int kManyAdded = 8;
constexpr double kClearlyBetter = 0.85;
/// Over few pairs it may be 0.87. With 1.24 times the right one, the right one leaves about 0.5.
constexpr double kFarBetter = 0.7;
/// Pairs with fewer textured points have no correlation.
constexpr int kLeastCompared = 300;

/// The points as a camera of another focal length would have measured them.
std::vector<std::vector<ReferencePoint>> withFocal(std::vector<std::vector<ReferencePoint>> levels, double factor) {
  const auto k = static_cast<float>(factor);
  for (std::vector<ReferencePoint>& level : levels)
    for (ReferencePoint& point : level) {
      point.point_camera_m.tail<2>() /= k;
      if (!point.hasNormal()) continue;
      point.normal_camera.tail<2>() *= k;
      point.normal_camera.normalize();
    }
  return levels;
}

FramePyramid withFocal(FramePyramid pyramid, double factor) {
  for (PyramidLevel& level : pyramid) {
    level.camera.fx_px *= factor;
    level.camera.fy_px *= factor;
  }
  return pyramid;
}

}  // namespace

void FocalCheck::add(const FramePyramid& frame, const RgbdPose& pose, const KeyFrame& key,
                     const common::Pose3& T_map_key, const RgbdOdometryConfig& config) {
  if (isDone()) return;
  std::array<double, kFactors.size()> unexplained{};
  for (std::size_t i = 0; i < kFactors.size(); ++i) {
    const auto levels = withFocal(key.levels, kFactors[i]);
    const std::vector<ReferenceView> view{{T_map_key, &levels}};
    const Alignment fit = align(withFocal(frame, kFactors[i]), view, {pose.T_map_camera, Matrix6d::Zero()},
                                pose.fit.exposure, config.features.depth_noise, config.alignment);
    const bool is_compared = fit.textured >= kLeastCompared;
    if (!is_compared && i == 0) return;
    // Far from the right focal length the views may hardly overlap any more.
    unexplained[i] = is_compared ? 1.0 - fit.correlation : 1.0;
  }
  ++added_;
  for (std::size_t i = 0; i < kFactors.size(); ++i) unexplained_[i] += unexplained[i];
}

bool FocalCheck::canTell() const { return added_ >= kLeastAdded; }

std::optional<double> FocalCheck::betterFactor() const {
  if (!canTell()) return std::nullopt;
  const auto best = std::min_element(unexplained_.begin(), unexplained_.end());
  const double share = added_ < kManyAdded ? kFarBetter : kClearlyBetter;
  if (*best > share * unexplained_.front()) return std::nullopt;
  return kFactors[static_cast<std::size_t>(best - unexplained_.begin())];
}

}  // namespace swiftlet::mapping3d
