#include "apps/cloud_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace swiftlet::apps {
namespace {

/// Of a camera's picture every so many pixels in each direction make points: cubes hold many pixels each.
constexpr int kPixelStep = 2;
/// A cube counts when so many points fell into it; single ones are noise at edges.
constexpr std::uint32_t kLeastPoints = 2;
/// Bits of each coordinate of a cube: a million cubes each way.
constexpr int kBits = 21;

std::uint64_t part(double coordinate) {
  const auto cell = static_cast<std::int64_t>(std::floor(coordinate)) + (std::int64_t{1} << (kBits - 1));
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell, 0, (std::int64_t{1} << kBits) - 1));
}

}  // namespace

void CloudGrid::add(const common::RgbdFrame& frame, const common::Pose3& T_map_camera, double farthest_m) {
  for (int v = 0; v < frame.camera.height_px; v += kPixelStep)
    for (int u = 0; u < frame.camera.width_px; u += kPixelStep) {
      const float depth = frame.depth.at(u, v);
      if (!common::isMeasured(depth) || static_cast<double>(depth) > farthest_m) continue;
      const Eigen::Vector3d point_m = T_map_camera * frame.camera.point_camera_m(u, v, static_cast<double>(depth));
      const Eigen::Vector3d cell = point_m / cube_m_;
      Sums& sums = cubes_[part(cell.x()) << (2 * kBits) | part(cell.y()) << kBits | part(cell.z())];
      const auto at = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.camera.width_px) +
                           static_cast<std::size_t>(u));
      sums.points_m += point_m;
      sums.red += frame.color.rgb[at];
      sums.green += frame.color.rgb[at + 1];
      sums.blue += frame.color.rgb[at + 2];
      ++sums.count;
    }
}

std::vector<interfaces::ColoredPoint> CloudGrid::points() const {
  std::vector<std::uint64_t> order;
  for (const auto& [cube, sums] : cubes_)
    if (sums.count >= kLeastPoints) order.push_back(cube);
  std::sort(order.begin(), order.end());
  std::vector<interfaces::ColoredPoint> points;
  points.reserve(order.size());
  for (const std::uint64_t cube : order) {
    const Sums& sums = cubes_.at(cube);
    const auto mean = [&](std::uint32_t sum) { return static_cast<std::uint8_t>(sum / sums.count); };
    points.push_back({(sums.points_m / sums.count).cast<float>(), mean(sums.red), mean(sums.green), mean(sums.blue)});
  }
  return points;
}

}  // namespace swiftlet::apps
