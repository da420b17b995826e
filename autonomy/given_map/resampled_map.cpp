#include "autonomy/given_map/resampled_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
namespace occupancy = common::occupancy;

bool allOccupied(const OccupancyGrid& grid, CellIndex corner, int side) {
  for (int y = corner.y; y < corner.y + side; ++y)
    for (int x = corner.x; x < corner.x + side; ++x)
      if (!occupancy::isOccupied(grid.at({x, y}))) return false;
  return true;
}

/// Whether the cell belongs to no occupied square of so many cells a side.
bool isThin(const OccupancyGrid& grid, CellIndex cell, int side) {
  for (int dy = 0; dy < side; ++dy)
    for (int dx = 0; dx < side; ++dx)
      if (allOccupied(grid, {cell.x - dx, cell.y - dy}, side)) return false;
  return true;
}

/// Where the source reaches in the cells of the target: its corners, turned.
common::CellRect reachIn(const OccupancyGrid& target, const OccupancyGrid& source,
                         const common::Pose2& T_target_source) {
  const common::CellRect known = common::knownExtent(source);
  if (known.empty()) return {};
  const auto at_m = [&](int x, int y) -> Eigen::Vector2d {
    return T_target_source * (source.resolution_m() * Eigen::Vector2d(x, y));
  };
  Eigen::Vector2d low_m = at_m(known.begin.x, known.begin.y), high_m = low_m;
  for (const Eigen::Vector2d& corner_m :
       {at_m(known.begin.x, known.end.y), at_m(known.end.x, known.begin.y), at_m(known.end.x, known.end.y)}) {
    low_m = low_m.cwiseMin(corner_m);
    high_m = high_m.cwiseMax(corner_m);
  }
  const CellIndex last = target.cellAt(high_m);
  return {target.cellAt(low_m), {last.x + 1, last.y + 1}};
}

}  // namespace

ResampledMap::ResampledMap(const OccupancyGrid& source, double resolution_m) : resolution_m_(resolution_m) {
  // A band at least as wide as the diagonal of a target cell holds the centre of a cell wherever it is crossed.
  const int side = std::max(2, static_cast<int>(std::ceil(std::numbers::sqrt2 * resolution_m / source.resolution_m())));
  // Neighbours on their right and above, so that each pair comes once.
  constexpr std::array<CellIndex, 4> kAhead{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}}};
  source.forEachCell([&](CellIndex cell, occupancy::Cell value) {
    if (!occupancy::isOccupied(value)) return;
    const bool thin = isThin(source, cell, side);
    const Eigen::Vector2d center_m = source.centerOf(cell);
    if (thin) thin_walls_.push_back({center_m, value});
    for (const CellIndex ahead : kAhead) {
      const CellIndex next{cell.x + ahead.x, cell.y + ahead.y};
      if (!occupancy::isOccupied(source.at(next)) || (!thin && !isThin(source, next, side))) continue;
      // Points less than a cell apart fall into the same cell, or into neighbours. Both ends are among them: a thin
      // wall joins a thick one at the centre of that one's cell.
      const Eigen::Vector2d step_m = source.centerOf(next) - center_m;
      const int pieces = 1 + static_cast<int>(step_m.norm() / resolution_m);
      for (int i = 0; i <= pieces; ++i)
        thin_walls_.push_back({center_m + i * step_m / static_cast<double>(pieces), value});
    }
  });
}

OccupancyGrid ResampledMap::drawn(const OccupancyGrid& source, const common::Pose2& T_target_source) const {
  OccupancyGrid target = common::makeOccupancyGrid(resolution_m_);
  const common::CellRect reach = reachIn(target, source, T_target_source);
  const common::Pose2 T_source_target = T_target_source.inverse();
  for (int y = reach.begin.y; y < reach.end.y; ++y)
    for (int x = reach.begin.x; x < reach.end.x; ++x) {
      const auto value = source.at(source.cellAt(T_source_target * target.centerOf({x, y})));
      if (!occupancy::isUnknown(value)) target.set({x, y}, value);
    }
  for (const Point& point : thin_walls_) target.set(target.cellAt(T_target_source * point.at_source_m), point.value);
  return target;
}

}  // namespace swiftlet::autonomy
