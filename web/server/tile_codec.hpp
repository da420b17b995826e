// Map tiles as bytes for the page: nine shades, run-length coded. A seen tile compresses to some hundred bytes, and a
// repeated observation of known cells changes nothing in it.
#pragma once

#include <string>

#include "common/occupancy_grid.hpp"

namespace swiftlet::web {

/// 0: unknown; 1 (surely) to 4 (barely): free; 5 (barely) to 8 (surely): occupied.
int shadeOf(common::occupancy::Cell cell);

/// The tile whose lower left cell is `corner`, row by row from the bottom. Each run is one byte `shade << 4 | n`, n the
/// length minus 1 up to 14; n = 15: two more bytes, low first, hold the length minus 1.
std::string encodeTile(const common::OccupancyGrid& grid, common::CellIndex corner);

}  // namespace swiftlet::web
