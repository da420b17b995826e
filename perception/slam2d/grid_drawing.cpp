#include "perception/slam2d/grid_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace swiftlet::perception {
namespace {

using common::CellIndex;

/// A mark counts the beams that crossed a cell in its low half, those that ended there in its high half.
constexpr std::uint32_t kCrossed = 1;
constexpr std::uint32_t kEnded = 1 << 16;

/// In cells of the grid, with fractions.
std::vector<Eigen::Vector2d> toGrid(const std::vector<Eigen::Vector2f>& points_level_m, const common::Pose2& T_map_body,
                                    double resolution_m) {
  const double c = std::cos(T_map_body.yaw_rad), s = std::sin(T_map_body.yaw_rad);
  std::vector<Eigen::Vector2d> points;
  points.reserve(points_level_m.size());
  for (const Eigen::Vector2f& p : points_level_m)
    points.emplace_back((T_map_body.x_m + c * p.x() - s * p.y()) / resolution_m,
                        (T_map_body.y_m + s * p.x() + c * p.y()) / resolution_m);
  return points;
}

CellIndex cellOf(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
}

}  // namespace

DrawnScan thinForDrawing(const ProjectedScan& scan, const GridDrawingConfig& config) {
  DrawnScan drawn;
  drawn.stamp = scan.stamp;
  const auto spacing = static_cast<float>(0.4 * config.resolution_m);
  const auto add = [&](std::vector<Eigen::Vector2f>& list, const Eigen::Vector2f& p) {
    if (list.empty() || (p - list.back()).squaredNorm() > spacing * spacing) list.push_back(p);
  };
  const auto cutTo = [](const Eigen::Vector2f& p, double range_m) -> Eigen::Vector2f {
    const float norm = p.norm();
    return norm > static_cast<float>(range_m) ? Eigen::Vector2f(p * (static_cast<float>(range_m) / norm)) : p;
  };
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const Eigen::Vector2f& p = scan.points_level_m[i];
    if (!p.allFinite()) continue;
    const float height = i < scan.heights_level_m.size() ? scan.heights_level_m[i] : 0.0F;
    // A view that ended far above or below says that the cells on the way are free near the body only.
    const bool off_height = height > config.max_height_above_m || -height > config.max_height_below_m;
    if (off_height) continue;
    if (p.norm() > static_cast<float>(config.max_hit_range_m))
      add(drawn.free_level_m, cutTo(p, config.max_hit_range_m));
    else
      add(drawn.hits_level_m, p);
  }
  for (const Eigen::Vector2f& p : scan.misses_level_m)
    if (p.allFinite()) add(drawn.free_level_m, cutTo(p, config.max_free_range_m));
  return drawn;
}

void GridDrawer::draw(const DrawnScan& scan, const common::Pose2& T_map_body, common::OccupancyGrid& grid) {
  const Eigen::Vector2d body = T_map_body.position_m() / grid.resolution_m();
  hits_ = toGrid(scan.hits_level_m, T_map_body, grid.resolution_m());
  frees_ = toGrid(scan.free_level_m, T_map_body, grid.resolution_m());
  const CellIndex center = cellOf(body);
  rect_ = {center, {center.x + 1, center.y + 1}};
  for (const auto* points : {&hits_, &frees_}) {
    for (const Eigen::Vector2d& p : *points) {
      const CellIndex c = cellOf(p);
      rect_.begin = {std::min(rect_.begin.x, c.x), std::min(rect_.begin.y, c.y)};
      rect_.end = {std::max(rect_.end.x, c.x + 1), std::max(rect_.end.y, c.y + 1)};
    }
  }
  marks_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()), 0);
  for (const Eigen::Vector2d& p : frees_) {
    markRay(body, p);
    markAt(cellOf(p)) += kCrossed;
  }
  for (const Eigen::Vector2d& p : hits_) {
    markRay(body, p);
    markAt(cellOf(p)) += kEnded;
  }
  apply(grid);
}

/// Every cell the line touches, up to, but without, that of its end (Amanatides and Woo 1987). Lines through cell
/// centres only would leave pinholes between the rays, and each would be a frontier.
void GridDrawer::markRay(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const CellIndex begin = cellOf(from), end = cellOf(to);
  const Eigen::Vector2d way = to - from;
  int left_x = std::abs(end.x - begin.x), left_y = std::abs(end.y - begin.y);
  const double per_x = 1.0 / std::max(std::abs(way.x()), 1e-12), per_y = 1.0 / std::max(std::abs(way.y()), 1e-12);
  double next_x = per_x * (way.x() >= 0.0 ? begin.x + 1 - from.x() : from.x() - begin.x);
  double next_y = per_y * (way.y() >= 0.0 ? begin.y + 1 - from.y() : from.y() - begin.y);
  const std::ptrdiff_t step_x = way.x() >= 0.0 ? 1 : -1;
  const std::ptrdiff_t step_y = way.y() >= 0.0 ? rect_.width() : -static_cast<std::ptrdiff_t>(rect_.width());
  std::uint32_t* mark = &markAt(begin);
  while (left_x + left_y > 0) {
    *mark += kCrossed;
    if (left_y == 0 || (left_x > 0 && next_x < next_y)) {
      mark += step_x;
      next_x += per_x;
      --left_x;
    } else {
      mark += step_y;
      next_y += per_y;
      --left_y;
    }
  }
}

/// Where beams end and others pass, most decide: noise that puts some ends before or behind the wall does not thicken
/// it. But a cell in which any ends is never called free, so that a wall seen at a grazing angle gets no holes.
void GridDrawer::apply(common::OccupancyGrid& grid) const {
  const std::uint32_t* mark = marks_.data();
  for (int y = rect_.begin.y; y < rect_.end.y; ++y) {
    for (int x = rect_.begin.x; x < rect_.end.x; ++x, ++mark) {
      if (*mark == 0) continue;
      const std::uint32_t ended = *mark >> 16, crossed = *mark & 0xFFFF;
      if (ended > 0 && ended < crossed) continue;
      const common::occupancy::Cell old = grid.at({x, y});
      const int sum =
          (common::occupancy::isUnknown(old) ? 0 : old) + (ended > 0 ? config_.hit_steps : -config_.free_steps);
      const auto value = static_cast<common::occupancy::Cell>(std::clamp(sum, -config_.max_steps, config_.max_steps));
      // Not writing what does not change leaves the tile shared with the snapshots.
      if (value != old) grid.set({x, y}, value);
    }
  }
}

}  // namespace swiftlet::perception
