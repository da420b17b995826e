// Whether a map has something near a cell: two maps of one place show the same wall some cells apart.
#pragma once

#include "common/occupancy_grid.hpp"

namespace swiftlet::autonomy {

/// In the square of so many cells to each side.
inline bool occupiedNear(const common::OccupancyGrid& grid, common::CellIndex cell, int around_cells) {
  for (int dy = -around_cells; dy <= around_cells; ++dy)
    for (int dx = -around_cells; dx <= around_cells; ++dx)
      if (common::occupancy::isOccupied(grid.at({cell.x + dx, cell.y + dy}))) return true;
  return false;
}

}  // namespace swiftlet::autonomy
