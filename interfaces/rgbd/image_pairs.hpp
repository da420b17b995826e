// Which colour and which depth image are of the same time.
#pragma once

#include <cstddef>
#include <vector>

#include "common/time.hpp"

namespace swiftlet::interfaces {

/// TUM: two images are a pair if their stamps are at most this apart, as in the benchmark's associate.py.
inline constexpr double kPairedWithin_s = 0.02;

/// Indices of two images.
struct ImagePair {
  std::size_t color = 0, depth = 0;
};

/// Both lists are in the order of their stamps. Each image is used once, the nearest pairs first; pairs are in the
/// order of their colour images.
std::vector<ImagePair> pairsOf(const std::vector<common::Time>& colors, const std::vector<common::Time>& depths);

/// How far apart the nearest two are, of two lists in the order of their stamps; infinite if one is empty.
double nearestPair_s(const std::vector<common::Time>& colors, const std::vector<common::Time>& depths);

}  // namespace swiftlet::interfaces
