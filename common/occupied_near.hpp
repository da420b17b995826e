// Whether a map has something near a cell: two maps of one place show the same wall some cells apart.
#pragma once

#include "common/occupancy_grid.hpp"

namespace swiftlet::common {

/// Whether is(cell) holds for any cell in the square that reaches `around_cells` to each side of `cell`.
template <typename Is>
bool anyNear(CellIndex cell, int around_cells, Is&& is) {
  for (int dy = -around_cells; dy <= around_cells; ++dy)
    for (int dx = -around_cells; dx <= around_cells; ++dx)
      if (is(CellIndex{cell.x + dx, cell.y + dy})) return true;
  return false;
}

/// Whether any cell of the square that reaches `around_cells` to each side of `cell` is occupied.
inline bool occupiedNear(const OccupancyGrid& grid, CellIndex cell, int around_cells) {
  return anyNear(cell, around_cells, [&](CellIndex near) { return occupancy::isOccupied(grid.at(near)); });
}

}  // namespace swiftlet::common
