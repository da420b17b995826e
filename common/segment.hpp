// Line segments in the plane, and lines of several of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

/// The fraction of the segment from `from` to `to` at which it is nearest to `point`, in [0, 1]; 0 for a segment
/// without length. All in the same frame and unit.
inline double shareNearest(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  return squared > 0.0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
}

/// In the unit of the points.
inline double segmentDistance(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return (point - from - shareNearest(point, from, to) * (to - from)).norm();
}

/// The length of the line through the points, in their unit; 0 for fewer than two.
inline double polylineLength(const std::vector<Eigen::Vector2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

}  // namespace swiftlet::common
