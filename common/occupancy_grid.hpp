// The 2D occupancy map that all folders share: log odds in one byte, capped, in the `map` frame.
#pragma once

#include <cstdint>

#include "common/tiled_grid.hpp"

namespace swiftlet::common {

/// Log odds of being occupied in steps of kLogOddsPerStep; kUnknown was never observed.
/// Values are capped to +-kMaxSteps, so that a cell that changed can change back soon (Bachrach 2009, section 5.3).
namespace occupancy {
using Cell = std::int8_t;
inline constexpr Cell kUnknown = INT8_MIN;
inline constexpr Cell kMaxSteps = 100;
inline constexpr double kLogOddsPerStep = 0.05;

inline constexpr bool isUnknown(Cell c) { return c == kUnknown; }
/// Probability above 0.5.
inline constexpr bool isOccupied(Cell c) { return c > 0; }
inline constexpr bool isFree(Cell c) { return c != kUnknown && c <= 0; }
/// In [0, 1]; 0.5 for unknown.
double probability(Cell c);
}  // namespace occupancy

using OccupancyGrid = TiledGrid<occupancy::Cell>;

/// An empty map: everything unknown.
inline OccupancyGrid makeOccupancyGrid(double resolution_m) { return OccupancyGrid(resolution_m, occupancy::kUnknown); }

/// The smallest rectangle that holds every known cell; empty when there is none.
CellRect knownExtent(const OccupancyGrid& grid);

}  // namespace swiftlet::common
