// Updates one grid to equal another without unsharing the tiles in which nothing changed.
#pragma once

#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::perception {

/// Makes `grid` equal to `fresh`. Only cells that differ are written, so tiles without changes stay shared with older
/// snapshots of `grid`.
inline void makeEqual(common::OccupancyGrid& grid, const common::OccupancyGrid& fresh) {
  std::vector<common::CellIndex> changed;
  const auto compare = [&](common::CellIndex c, common::occupancy::Cell) {
    if (fresh.at(c) != grid.at(c)) changed.push_back(c);
  };
  fresh.forEachCell(compare);
  // Also finds the cells that are known in `grid` but unknown in `fresh`.
  grid.forEachCell(compare);
  for (const common::CellIndex& c : changed) grid.set(c, fresh.at(c));
}

}  // namespace swiftlet::perception
