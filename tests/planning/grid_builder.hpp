// Small worlds for the tests, drawn in text or at random.
#pragma once

#include <string>
#include <vector>

#include "common/occupancy_grid.hpp"
#include "common/random.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning::test {

inline constexpr common::occupancy::Cell kFreeCell = -60;
inline constexpr common::occupancy::Cell kWallCell = 60;

/// Fills the half-open rectangle of cells.
inline void fill(common::OccupancyGrid& grid, common::CellRect rect, common::occupancy::Cell value) {
  for (int y = rect.begin.y; y < rect.end.y; ++y)
    for (int x = rect.begin.x; x < rect.end.x; ++x) grid.set({x, y}, value);
}

/// A room of free cells with walls around it, one cell thick.
inline common::OccupancyGrid room(int width, int height, double resolution_m = 0.05) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(resolution_m);
  fill(grid, {{-1, -1}, {width + 1, height + 1}}, kWallCell);
  fill(grid, {{0, 0}, {width, height}}, kFreeCell);
  return grid;
}

/// Random boxes and specks of all three states.
inline void clutter(common::OccupancyGrid& grid, common::CellRect within, int count, common::RandomStream& random) {
  for (int i = 0; i < count; ++i) {
    const int x = within.begin.x + static_cast<int>(random.uniform() * within.width());
    const int y = within.begin.y + static_cast<int>(random.uniform() * within.height());
    const int w = 1 + static_cast<int>(random.uniform() * 12), h = 1 + static_cast<int>(random.uniform() * 12);
    const double kind = random.uniform();
    const common::occupancy::Cell value = kind < 0.5 ? kWallCell : kind < 0.8 ? kFreeCell : common::occupancy::kUnknown;
    fill(grid, {{x, y}, {std::min(x + w, within.end.x), std::min(y + h, within.end.y)}}, value);
  }
}

inline CostMap mapOf(common::OccupancyGrid& grid, const Footprint& footprint = {}, const CostMap::Config& config = {},
                     const CostLayers& layers = {}) {
  CostMap map(config, grid.resolution_m());
  map.update(grid.snapshot(), footprint, layers);
  return map;
}

}  // namespace swiftlet::planning::test
