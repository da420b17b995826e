// Some of many, evenly spread.
#pragma once

#include <cstddef>

namespace swiftlet::perception {

/// Which of `size` things is the i-th of `kept` that are taken, each from the middle of its share; i < kept <= size.
inline std::size_t evenlySpread(std::size_t i, std::size_t kept, std::size_t size) {
  return (2 * i + 1) * size / (2 * kept);
}

}  // namespace swiftlet::perception
