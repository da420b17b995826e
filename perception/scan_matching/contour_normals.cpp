#include "perception/scan_matching/contour_normals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {
namespace {

/// Where beams are dense, the line is fitted through the neighbours within this distance on either side.
constexpr float kReach_m = 0.15F;
/// Where beams are sparse, the line is fitted through at least this many neighbours on either side.
constexpr std::size_t kLeastNeighbours = 2;
/// A shorter stretch has no reliable direction.
constexpr float kLeastLength_m = 0.08F;
/// Largest ratio of the variance across a line to the variance along it. Corners exceed it.
constexpr double kMaxFlatness = 0.05;

/// Sums over the points before index i, so that the moments of any stretch are the difference of two entries.
struct Moments {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

std::vector<Moments> runningMoments(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Moments> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x(), y = points[i].y();
    const Moments& s = sums[i];
    sums[i + 1] = {s.x + x, s.y + y, s.xx + x * x, s.xy + x * y, s.yy + y * y};
  }
  return sums;
}

struct Line {
  Eigen::Vector2f middle_m, normal;
};

/// The line through the points first .. last; nullopt if they do not lie on one.
std::optional<Line> lineThrough(const std::vector<Moments>& sums, std::size_t first, std::size_t last) {
  const Moments &a = sums[first], &b = sums[last + 1];
  const auto n = static_cast<double>(last + 1 - first);
  const double mean_x = (b.x - a.x) / n, mean_y = (b.y - a.y) / n;
  const double xx = (b.xx - a.xx) / n - mean_x * mean_x, yy = (b.yy - a.yy) / n - mean_y * mean_y;
  const double xy = (b.xy - a.xy) / n - mean_x * mean_y;
  const double half_trace = 0.5 * (xx + yy), half_difference = 0.5 * (xx - yy);
  const double root = std::sqrt(half_difference * half_difference + xy * xy);
  if (half_trace - root > kMaxFlatness * (half_trace + root)) return std::nullopt;
  // Direction of the line, from whichever of the two forms is not nearly zero.
  const Eigen::Vector2d along =
      half_difference > 0.0 ? Eigen::Vector2d(half_difference + root, xy) : Eigen::Vector2d(xy, root - half_difference);
  const double length = along.norm();
  if (!(length > 0.0)) return std::nullopt;
  return Line{Eigen::Vector2d(mean_x, mean_y).cast<float>(),
              Eigen::Vector2d(-along.y() / length, along.x() / length).cast<float>()};
}

/// The stretch of the contour around a point, through which its line is fitted. Both ends only move forward.
class Stretch {
 public:
  Stretch(const std::vector<Eigen::Vector2f>& points, std::vector<bool> joins)
      : points_(points), joins_(std::move(joins)) {}

  /// Moves to point i. The indices must not decrease.
  void moveTo(std::size_t i) {
    for (; at_ < i; ++at_)
      if (!joins_[at_]) first = at_ + 1;
    while (i - first > kLeastNeighbours && !isNear(first, i)) ++first;
    last = std::max(last, i);
    while (joins_[last] && (last - i < kLeastNeighbours || isNear(last + 1, i))) ++last;
  }
  bool isLong() const { return (points_[last] - points_[first]).squaredNorm() > kLeastLength_m * kLeastLength_m; }

  std::size_t first = 0, last = 0;

 private:
  bool isNear(std::size_t j, std::size_t i) const {
    return (points_[j] - points_[i]).squaredNorm() < kReach_m * kReach_m;
  }

  const std::vector<Eigen::Vector2f>& points_;
  std::vector<bool> joins_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<OrientedPoint> orientedPoints(const ProjectedScan& scan, int count, double max_gap_m, double max_range_m) {
  const auto max2 = static_cast<float>(max_range_m * max_range_m);
  const bool with_heights = scan.heights_level_m.size() == scan.points_level_m.size();
  std::vector<Eigen::Vector2f> points;
  std::vector<float> heights;
  points.reserve(scan.points_level_m.size());
  heights.reserve(scan.points_level_m.size());
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    if (!(scan.points_level_m[i].squaredNorm() <= max2)) continue;  // Also skips NaN.
    points.push_back(scan.points_level_m[i]);
    heights.push_back(with_heights ? scan.heights_level_m[i] : 0.0F);
  }

  const int all = static_cast<int>(points.size());
  const std::vector<Moments> sums = runningMoments(points);
  Stretch stretch(points, joinsOf(points, max_gap_m));
  const std::vector<int> chosen = spreadIndices(points, count == 0 ? all : count, max_range_m);
  std::vector<OrientedPoint> result;
  result.reserve(chosen.size());
  for (const int index : chosen) {
    const auto i = static_cast<std::size_t>(index);
    stretch.moveTo(i);
    if (!stretch.isLong()) continue;
    const std::optional<Line> line = lineThrough(sums, stretch.first, stretch.last);
    if (!line) continue;
    const Eigen::Vector2f foot_m = points[i] + line->normal * line->normal.dot(line->middle_m - points[i]);
    const bool away = line->normal.dot(points[i]) > 0.0F;
    result.push_back({points[i], away ? Eigen::Vector2f(-line->normal) : line->normal, foot_m, heights[i]});
  }
  return result;
}

}  // namespace swiftlet::perception
