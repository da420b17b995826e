// The nearest point of a line segment in the plane.
#pragma once

#include <algorithm>

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

}  // namespace swiftlet::common
