#include "perception/scan_matching/split_points.hpp"

#include <algorithm>
#include <utility>

#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {
namespace {

/// Shorter runs of points without support are noise or a person.
constexpr std::size_t kLeastUnseen = 3;

}  // namespace

SplitPoints::SplitPoints(const std::vector<Eigen::Vector2f>& points_m) {
  x_m.reserve(points_m.size());
  y_m.reserve(points_m.size());
  for (const Eigen::Vector2f& p : points_m) {
    x_m.push_back(p.x());
    y_m.push_back(p.y());
  }
}

SplitPoints spreadWithHeights(const ProjectedScan& scan, int count, double max_range_m) {
  std::vector<Eigen::Vector2f> points;
  std::vector<float> heights;
  for (const int i : spreadIndices(scan.points_level_m, count, max_range_m)) {
    points.push_back(scan.points_level_m[static_cast<std::size_t>(i)]);
    if (scan.heights_level_m.size() == scan.points_level_m.size())
      heights.push_back(scan.heights_level_m[static_cast<std::size_t>(i)]);
  }
  SplitPoints result(points);
  result.heights_m = std::move(heights);
  return result;
}

std::vector<bool> awayFromUnseen(const SplitPoints& points, const std::vector<bool>& seen, double reach_m) {
  const std::size_t size = points.x_m.size();
  const auto reach2 = static_cast<float>(reach_m * reach_m);
  const auto near = [&](std::size_t i, std::size_t j) {
    const float dx = points.x_m[i] - points.x_m[j], dy = points.y_m[i] - points.y_m[j];
    return dx * dx + dy * dy < reach2;
  };
  std::vector<bool> kept = seen;
  for (std::size_t begin = 0, end; begin < size; begin = end + 1) {
    for (end = begin; end < size && !seen[end];) ++end;
    if (end - begin < kLeastUnseen) continue;
    for (std::size_t j = end; j < size && seen[j] && near(end - 1, j); ++j) kept[j] = false;
    for (std::size_t j = begin; j-- > 0 && seen[j] && near(begin, j);) kept[j] = false;
  }
  return kept;
}

SplitPoints marked(const SplitPoints& points, const std::vector<bool>& marks) {
  SplitPoints result({});
  for (std::size_t i = 0; i < points.x_m.size(); ++i) {
    if (!marks[i]) continue;
    result.x_m.push_back(points.x_m[i]);
    result.y_m.push_back(points.y_m[i]);
    if (!points.heights_m.empty()) result.heights_m.push_back(points.heights_m[i]);
  }
  return result;
}

SplitPoints mostOf(const SplitPoints& points, const std::vector<bool>& marks) {
  const auto count = static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
  return 2 * count < points.x_m.size() ? points : marked(points, marks);
}

}  // namespace swiftlet::perception
