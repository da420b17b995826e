// The exact Euclidean distance transform with a bounded reach. It works tile by tile, so that only the changed part of
// a map is computed again. Two passes: down and up the columns, then across the rows (Saito and Toriwaki 1994).
#pragma once

#include <cstdint>
#include <vector>

#include "common/tiled_grid.hpp"
#include "planning/costs/cell_state.hpp"

namespace swiftlet::planning {

/// Greatest distance that is computed, in cells; less than the side of a tile.
inline constexpr int kMaxReachCells = 63;

/// An array of states in row-major order.
struct StateImage {
  const std::vector<CellState>& states;
  int width;
  int height;
};

/// Writes into `squared` (same shape as the image), for the 64 x 64 cells from column `x0` and row `y0` on, the squared
/// distance in cells to the nearest cell in state `which`, cut at (reach + 1) squared. Outside the image nothing is in
/// that state. 0 <= reach <= kMaxReachCells.
void tileDistances(const StateImage& image, int x0, int y0, CellState which, int reach,
                   std::vector<std::int16_t>& squared);

}  // namespace swiftlet::planning
