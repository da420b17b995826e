#include "autonomy/given_map/resampled_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
namespace occupancy = common::occupancy;

/// The cells that belong to an occupied square of this side in cells: what a morphological opening leaves of the map.
class ThickWalls {
 public:
  ThickWalls(const OccupancyGrid& grid, int side)
      : rect_(common::knownExtent(grid)), width_(static_cast<std::size_t>(rect_.width())) {
    if (rect_.empty()) return;
    thick_.assign(width_ * static_cast<std::size_t>(rect_.height()), 0);
    markFarCorners(grid, side);
    // From its far corner a square covers the cells before it, first along x, then along y.
    spread(side, 1, rect_.width(), width_, rect_.height());
    spread(side, width_, rect_.height(), 1, rect_.width());
  }

  bool has(CellIndex cell) const { return rect_.contains(cell) && thick_[indexOf(cell)] != 0; }

 private:
  std::size_t indexOf(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - rect_.begin.y) * width_ + static_cast<std::size_t>(cell.x - rect_.begin.x);
  }
  /// The largest square that ends at a cell is one larger than the smallest of those that end before it.
  void markFarCorners(const OccupancyGrid& grid, int side) {
    std::vector<int> above(width_ + 1, 0), here(width_ + 1, 0);
    for (int y = rect_.begin.y; y < rect_.end.y; ++y) {
      for (int x = rect_.begin.x; x < rect_.end.x; ++x) {
        const auto i = static_cast<std::size_t>(x - rect_.begin.x);
        here[i + 1] = occupancy::isOccupied(grid.at({x, y})) ? 1 + std::min({above[i], above[i + 1], here[i]}) : 0;
        if (here[i + 1] >= side) thick_[indexOf({x, y})] = 1;
      }
      std::swap(above, here);
    }
  }
  /// Marks the `side` - 1 cells before each one that is marked, in `lines` lines of `length` cells.
  void spread(int side, std::size_t step, int length, std::size_t line_step, int lines) {
    for (int line = 0; line < lines; ++line) {
      int left = 0;
      for (int i = length; i-- > 0;) {
        std::uint8_t& cell = thick_[static_cast<std::size_t>(line) * line_step + static_cast<std::size_t>(i) * step];
        if (cell != 0) left = side;
        if (left > 0) {
          cell = 1;
          --left;
        }
      }
    }
  }

  common::CellRect rect_;
  std::size_t width_;
  std::vector<std::uint8_t> thick_;
};

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
  const ThickWalls thick_walls(source, side);
  source.forEachCell([&](CellIndex cell, occupancy::Cell value) {
    if (!occupancy::isOccupied(value)) return;
    const bool thin = !thick_walls.has(cell);
    const Eigen::Vector2d center_m = source.centerOf(cell);
    if (thin) thin_walls_.push_back({center_m, value});
    for (const CellIndex ahead : kAhead) {
      const CellIndex next{cell.x + ahead.x, cell.y + ahead.y};
      if (!occupancy::isOccupied(source.at(next)) || (!thin && thick_walls.has(next))) continue;
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
