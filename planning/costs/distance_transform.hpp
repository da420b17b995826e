// The exact Euclidean distance transform with a bounded reach. It works tile by tile, so that only the changed part of
// a map is computed again. Two passes: down and up the columns, then across the rows (Saito and Toriwaki 1994).
#pragma once

#include <cstdint>
#include <vector>

#include "planning/costs/cell_states.hpp"

namespace swiftlet::planning {

/// Greatest distance that is computed, in cells; less than the side of a tile.
inline constexpr int kMaxReachCells = 63;

/// Writes into `squared` (an element for each cell of the states), for the 64 x 64 cells from column `x0` and row `y0`
/// on, the squared distance in cells to the nearest cell in state `which`, cut at (reach + 1) squared. Outside of them
/// nothing is in that state. 0 <= reach <= kMaxReachCells.
void tileDistances(const CellStates& states, int x0, int y0, CellState which, int reach,
                   std::vector<std::int16_t>& squared);

}  // namespace swiftlet::planning
