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

std::vector<CellIndex> cellsOf(const std::vector<Eigen::Vector2f>& points_level_m, const common::Pose2& T_map_body,
                               const common::OccupancyGrid& grid) {
  const double c = std::cos(T_map_body.yaw_rad), s = std::sin(T_map_body.yaw_rad);
  std::vector<CellIndex> cells;
  cells.reserve(points_level_m.size());
  for (const Eigen::Vector2f& p : points_level_m) {
    const CellIndex cell = grid.cellAt(T_map_body.x_m + c * p.x() - s * p.y(), T_map_body.y_m + s * p.x() + c * p.y());
    cells.push_back(cell);
  }
  return cells;
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
  const CellIndex body = grid.cellAt(T_map_body.position_m());
  hits_ = cellsOf(scan.hits_level_m, T_map_body, grid);
  frees_ = cellsOf(scan.free_level_m, T_map_body, grid);
  rect_ = {body, {body.x + 1, body.y + 1}};
  for (const auto* cells : {&hits_, &frees_}) {
    for (const CellIndex& c : *cells) {
      rect_.begin = {std::min(rect_.begin.x, c.x), std::min(rect_.begin.y, c.y)};
      rect_.end = {std::max(rect_.end.x, c.x + 1), std::max(rect_.end.y, c.y + 1)};
    }
  }
  marks_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()), 0);
  for (const CellIndex& c : frees_) {
    markRay(body, c);
    markAt(c) += kCrossed;
  }
  for (const CellIndex& c : hits_) {
    markRay(body, c);
    markAt(c) += kEnded;
  }
  apply(grid);
}

/// All cells from `from` up to, but without, `to`: one step along the longer axis at a time.
void GridDrawer::markRay(CellIndex from, CellIndex to) {
  const int dx = to.x - from.x, dy = to.y - from.y;
  const int steps = std::max(std::abs(dx), std::abs(dy));
  if (steps == 0) return;
  constexpr int kOne = 1 << 16;
  const std::int64_t step_x = static_cast<std::int64_t>(dx) * kOne / steps;
  const std::int64_t step_y = static_cast<std::int64_t>(dy) * kOne / steps;
  std::int64_t x = static_cast<std::int64_t>(from.x - rect_.begin.x) * kOne + kOne / 2;
  std::int64_t y = static_cast<std::int64_t>(from.y - rect_.begin.y) * kOne + kOne / 2;
  const auto width = static_cast<std::int64_t>(rect_.width());
  for (int i = 0; i < steps; ++i, x += step_x, y += step_y)
    marks_[static_cast<std::size_t>((y >> 16) * width + (x >> 16))] += kCrossed;
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
