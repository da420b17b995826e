// The cubes in which the noisy points of a cloud are compared with the others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/submap3d.hpp"

namespace swiftlet::mapping3d {

using LargeCube = Eigen::Matrix<std::int64_t, 3, 1>;

inline LargeCube largeCubeOf(const common::SurfacePoint& point, float side_m) {
  return (point.position_m / side_m).array().floor().cast<std::int64_t>();
}

/// Cubes with equal keys are a hundred kilometres apart. Cubes above each other have consecutive keys.
inline std::uint64_t keyOf(const LargeCube& cube) {
  constexpr std::int64_t kOrigin = 1 << 20;  // So that the numbers do not wrap around near the ground.
  const auto part = [](std::int64_t number) { return static_cast<std::uint64_t>(number + kOrigin) & 0x1fffffU; };
  return part(cube.x()) << 42U | part(cube.y()) << 21U | part(cube.z());
}

/// Whether `is(key)` for a cube up to `reach` from that one in each direction, itself included.
template <typename Is>
bool anyAround(const LargeCube& cube, int reach, const Is& is) {
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        if (is(keyOf(cube + LargeCube(x, y, z)))) return true;
  return false;
}

/// Points by their large cubes, in half the memory of the points.
class PointsByCube {
 public:
  PointsByCube(const std::vector<common::SurfacePoint>& points, float side_m) : points_(points), side_m_(side_m) {
    by_key_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      by_key_.emplace_back(keyOf(largeCubeOf(points[i], side_m)), static_cast<std::uint32_t>(i));
    std::sort(by_key_.begin(), by_key_.end());
  }

  /// Whether one of them is nearer to the point than a cube is wide.
  bool anyNear(const common::SurfacePoint& point) const {
    const LargeCube cube = largeCubeOf(point, side_m_);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const std::uint64_t above = keyOf(cube + LargeCube(x, y, 1));
        auto at = std::lower_bound(by_key_.begin(), by_key_.end(), std::pair(keyOf(cube + LargeCube(x, y, -1)), 0U));
        for (; at != by_key_.end() && at->first <= above; ++at)
          if ((points_[at->second].position_m - point.position_m).norm() < side_m_) return true;
      }
    return false;
  }

 private:
  const std::vector<common::SurfacePoint>& points_;
  float side_m_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_key_;
};

}  // namespace swiftlet::mapping3d
