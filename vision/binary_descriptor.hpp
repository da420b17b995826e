// Binary descriptors: 256 comparisons of smoothed pixels around a corner, turned with the patch (Calonder et al.,
// "BRIEF", ECCV 2010; Rublee et al., "ORB", ICCV 2011). They recognize a place that was left, where nothing predicts
// the pose.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "vision/gray_image.hpp"

namespace swiftlet::vision {

struct BinaryDescriptor {
  std::array<std::uint64_t, 4> bits{};

  /// Number of bits that differ, 0 to 256.
  int distance(const BinaryDescriptor& other) const {
    int count = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) count += std::popcount(bits[i] ^ other.bits[i]);
    return count;
  }
};

/// One for each pixel; none where the patch leaves the image.
std::vector<std::optional<BinaryDescriptor>> describePatches(const GrayImage& image,
                                                             std::span<const Eigen::Vector2d> pixels);

}  // namespace swiftlet::vision
