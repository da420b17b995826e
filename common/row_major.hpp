// Where a cell lies in an array that holds row after row.
#pragma once

#include <cstddef>

namespace swiftlet::common {

/// None of the three may be negative.
constexpr std::size_t rowMajor(int row, int width, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

}  // namespace swiftlet::common
