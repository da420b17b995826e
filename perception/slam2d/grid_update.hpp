// Making one grid equal to another so that tiles in which nothing changed stay shared with its older snapshots.
#pragma once

#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::perception {

inline void makeEqual(common::OccupancyGrid& grid, const common::OccupancyGrid& fresh) {
  std::vector<common::CellIndex> changed;
  const auto compare = [&](common::CellIndex c, common::occupancy::Cell) {
    if (fresh.at(c) != grid.at(c)) changed.push_back(c);
  };
  fresh.forEachCell(compare);
  grid.forEachCell(compare);  // What is unknown in the fresh one.
  for (const common::CellIndex& c : changed) grid.set(c, fresh.at(c));
}

}  // namespace swiftlet::perception
