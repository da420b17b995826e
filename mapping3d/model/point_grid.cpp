#include "mapping3d/model/point_grid.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::mapping3d {
namespace {

/// Bits of each coordinate of a cube: a million cubes each way.
constexpr int kBits = 21;

std::uint64_t part(float coordinate) {
  const auto cell = static_cast<std::int64_t>(std::floor(coordinate)) + (std::int64_t{1} << (kBits - 1));
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell, 0, (std::int64_t{1} << kBits) - 1));
}

}  // namespace

void PointGrid::add(std::span<const SeenPoint> points, const common::Pose3& T_submap_camera) {
  const Eigen::Matrix3f rotation = T_submap_camera.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f origin_m = T_submap_camera.position_m.cast<float>();
  for (const SeenPoint& point : points)
    add(rotation * point.position_m + origin_m, rotation * point.normal, point.rgb, point.weight);
}

void PointGrid::add(const WeightedPoints& points) {
  for (std::size_t i = 0; i < points.points->size(); ++i) {
    const common::SurfacePoint& point = (*points.points)[i];
    add(point.position_m, point.normal, point.rgb, points.weights[i]);
  }
}

void PointGrid::add(const Eigen::Vector3f& position_m, const Eigen::Vector3f& normal,
                    const std::array<std::uint8_t, 3>& rgb, float weight) {
  const Eigen::Vector3f cube = position_m / static_cast<float>(cube_m_);
  const std::uint64_t code = part(cube.x()) << (2 * kBits) | part(cube.y()) << kBits | part(cube.z());
  const auto [at, is_new] = cubes_.try_emplace(code, static_cast<std::uint32_t>(sums_.size()));
  if (is_new) sums_.emplace_back();
  Sums& sums = sums_[at->second];
  sums.position_m += weight * position_m;
  sums.normal += weight * normal;
  sums.rgb += weight * Eigen::Vector3f(rgb[0], rgb[1], rgb[2]);
  sums.weight += weight;
}

std::vector<common::SurfacePoint> PointGrid::points() const {
  std::vector<common::SurfacePoint> points;
  points.reserve(sums_.size());
  for (const Sums& sums : sums_) {
    common::SurfacePoint point;
    point.position_m = sums.position_m / sums.weight;
    if (const float length = sums.normal.norm(); length > 0.0F) point.normal = sums.normal / length;
    for (int i = 0; i < 3; ++i)
      point.rgb[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(sums.rgb[i] / sums.weight));
    points.push_back(point);
  }
  return points;
}

WeightedPoints PointGrid::weightedPoints() const {
  WeightedPoints weighted{std::make_shared<const std::vector<common::SurfacePoint>>(points()), {}};
  weighted.weights.reserve(sums_.size());
  for (const Sums& sums : sums_) weighted.weights.push_back(sums.weight);
  return weighted;
}

WeightedPoints thinned(const WeightedPoints& points, double cube_m) {
  PointGrid grid(cube_m);
  grid.add(points);
  return grid.weightedPoints();
}

}  // namespace swiftlet::mapping3d
