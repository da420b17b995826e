// What is known of a cell of the cost map.
#pragma once

#include <cstdint>

namespace swiftlet::planning {

/// What a cell is, after unknown slivers between beams were closed.
enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

}  // namespace swiftlet::planning
