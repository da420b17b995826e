// The state of a cell of the cost map.
#pragma once

#include <cstdint>

namespace swiftlet::planning {

/// In the states that CostMap returns, unknown slivers between beams count as free.
enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

}  // namespace swiftlet::planning
