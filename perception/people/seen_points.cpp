#include "perception/people/seen_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "common/geometry.hpp"

namespace swiftlet::perception {
namespace {

/// The degree of the bearing.
std::size_t degreeOf(const Eigen::Vector2d& offset_m) {
  const double degrees = (std::atan2(offset_m.y(), offset_m.x()) + std::numbers::pi) / common::kRadPerDeg;
  return std::min<std::size_t>(359, static_cast<std::size_t>(std::max(0.0, degrees)));
}

}  // namespace

SeenRanges::SeenRanges(const SeenPoints& seen) : SeenRanges() {
  from_map_m_ = seen.from_map_m;
  for (const Eigen::Vector2f& point : seen.points_map_m) {
    if (!point.allFinite()) continue;
    const Eigen::Vector2d offset_m = point.cast<double>() - from_map_m_;
    double& range_m = ranges_m_[degreeOf(offset_m)];
    range_m = range_m > 0.0 ? std::min(range_m, offset_m.norm()) : offset_m.norm();
  }
}

double SeenRanges::range_m(const Eigen::Vector2d& offset_m) const { return ranges_m_[degreeOf(offset_m)]; }

}  // namespace swiftlet::perception
