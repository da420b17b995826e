// Selection of an evenly spread subset.
#pragma once

#include <cstddef>

namespace swiftlet::perception {

/// The index, among `size` items, of the i-th of `kept` evenly spread ones. Each is taken from the middle of its share;
/// i < kept <= size.
inline std::size_t evenlySpread(std::size_t i, std::size_t kept, std::size_t size) {
  return (2 * i + 1) * size / (2 * kept);
}

}  // namespace swiftlet::perception
