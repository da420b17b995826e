// What a grid holds, for comparing two of them.
#pragma once

#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::test {

/// The place and value of each cell that is not background.
inline std::vector<int> bytesOf(const common::OccupancyGrid& grid) {
  std::vector<int> bytes;
  grid.forEachCell([&](common::CellIndex c, common::occupancy::Cell value) {
    if (value != grid.background()) bytes.insert(bytes.end(), {c.x, c.y, value});
  });
  return bytes;
}

}  // namespace swiftlet::test
