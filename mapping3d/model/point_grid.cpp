#include "mapping3d/model/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

/// Bits of each coordinate of a cube: a million cubes each way.
constexpr int kBits = 21;
/// A large cube with this many times less weight than one beside it has the noise of that one's points.
constexpr float kMostlyBeside = 5.0F;

std::uint64_t part(float coordinate) {
  const auto cell = static_cast<std::int64_t>(std::floor(coordinate)) + (std::int64_t{1} << (kBits - 1));
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell, 0, (std::int64_t{1} << kBits) - 1));
}

}  // namespace

PointGrid::PointGrid(double cube_m) : fine_{cube_m}, coarse_{common::kLargeCube * cube_m} {}

PointGrid::Key PointGrid::Cubes::keyOf(const Eigen::Vector3f& position_m) const {
  const Eigen::Vector3f cube = position_m / static_cast<float>(side_m);
  return part(cube.x()) << (2 * kBits) | part(cube.y()) << kBits | part(cube.z());
}

bool PointGrid::Cubes::add(const common::SurfacePoint& point, float weight) {
  const auto [at, is_new] = index.try_emplace(keyOf(point.position_m), static_cast<std::uint32_t>(sums.size()));
  if (is_new) sums.emplace_back();
  Sums& sum = sums[at->second];
  sum.position_m += weight * point.position_m;
  sum.normal += weight * point.normal;
  sum.rgb += weight * Eigen::Vector3f(point.rgb[0], point.rgb[1], point.rgb[2]);
  sum.weight += weight;
  return is_new;
}

common::SurfacePoint PointGrid::Sums::mean() const {
  common::SurfacePoint point;
  point.position_m = position_m / weight;
  if (const float length = normal.norm(); length > 0.0F) point.normal = normal / length;
  for (int i = 0; i < 3; ++i)
    point.rgb[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(rgb[i] / weight));
  return point;
}

void PointGrid::add(std::span<const SeenPoint> points, const common::Pose3& T_submap_camera) {
  const Eigen::Matrix3f rotation = T_submap_camera.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f origin_m = T_submap_camera.position_m.cast<float>();
  const auto least_weight = static_cast<float>(1.0 / (fine_.side_m * fine_.side_m));
  for (const SeenPoint& point : points) {
    const common::SurfacePoint placed{rotation * point.position_m + origin_m, rotation * point.normal, point.rgb};
    if (point.weight >= least_weight)
      addFine(placed, point.weight);
    else
      coarse_.add(placed, point.weight);
  }
}

void PointGrid::add(const WeightedPoints& points) {
  for (std::size_t i = 0; i < points.points->size(); ++i) {
    if (i < points.fine)
      addFine((*points.points)[i], points.weights[i]);
    else
      coarse_.add((*points.points)[i], points.weights[i]);
  }
}

void PointGrid::addFine(const common::SurfacePoint& point, float weight) {
  if (fine_.add(point, weight)) seen_well_.insert(coarse_.keyOf(point.position_m));
}

/// The surface may lie in the cube beside it, where most of its points are.
bool PointGrid::sawBetter(const Sums& sums) const {
  const auto side_m = static_cast<float>(coarse_.side_m);
  const Eigen::Vector3f mean_m = sums.position_m / sums.weight;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3f beside(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                                 static_cast<float>(i / 9 - 1));
    const Key key = coarse_.keyOf(mean_m + side_m * beside);
    if (seen_well_.count(key) > 0) return true;
    const auto noisy = coarse_.index.find(key);
    if (noisy != coarse_.index.end() && coarse_.sums[noisy->second].weight > kMostlyBeside * sums.weight) return true;
  }
  return false;
}

WeightedPoints PointGrid::points() const {
  std::vector<common::SurfacePoint> points;
  std::vector<float> weights;
  points.reserve(fine_.sums.size());
  weights.reserve(fine_.sums.size());
  const auto put = [&](const Sums& sums) {
    points.push_back(sums.mean());
    weights.push_back(sums.weight);
  };
  for (const Sums& sums : fine_.sums) put(sums);
  for (const Sums& sums : coarse_.sums)
    if (!sawBetter(sums)) put(sums);
  return {std::make_shared<const std::vector<common::SurfacePoint>>(std::move(points)), std::move(weights),
          fine_.sums.size()};
}

WeightedPoints thinned(const WeightedPoints& points, double cube_m) {
  PointGrid grid(cube_m);
  grid.add(points);
  return grid.points();
}

}  // namespace swiftlet::mapping3d
