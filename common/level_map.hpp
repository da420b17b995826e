// The surfaces below the vehicle as levels of constant height, each a set of cells (Grzonka 2012, section IV-C).
#pragma once

#include <vector>

#include "common/tiled_grid.hpp"

namespace swiftlet::common {

/// One connected surface of constant height, in the `map` frame, relative to the take-off floor.
struct Level {
  int id = 0;
  double height_m = 0.0;
  double variance_m2 = 0.0;
  std::vector<CellIndex> cells;  ///< Sorted.
};

struct LevelMap {
  double resolution_m = 0.1;
  std::vector<Level> levels;  ///< Ordered by id; several may cover one cell (a table above the floor).
};

}  // namespace swiftlet::common
