// Binary descriptors: 256 comparisons of smoothed pixels around a corner, turned with the patch (Calonder et al.,
// "BRIEF", ECCV 2010; Rublee et al., "ORB", ICCV 2011). They recognize a place that was left, where nothing predicts
// the pose.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
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

/// The most similar of the descriptors that were considered, with its distance and that of the second.
struct NearestDescriptor {
  std::size_t index = 0;
  int distance = 257, second = 257;

  void consider(int other, std::size_t at) {
    if (other < distance) {
      second = distance;
      distance = other;
      index = at;
    } else if (other < second) {
      second = other;
    }
  }
};

/// One for each pixel; none where the patch leaves the image.
std::vector<std::optional<BinaryDescriptor>> describePatches(const GrayImage& image,
                                                             std::span<const Eigen::Vector2d> pixels);

struct DescribedPatch {
  std::size_t index = 0;  ///< Of the corner.
  BinaryDescriptor descriptor;
};
/// Those of the corners, or features, whose patch lies in the image, in their order.
template <typename Corners>
std::vector<DescribedPatch> describedPatches(const GrayImage& image, const Corners& corners) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(corners.size());
  for (const auto& corner : corners) pixels.push_back(corner.pixel);
  const auto descriptors = describePatches(image, pixels);
  std::vector<DescribedPatch> described;
  for (std::size_t i = 0; i < descriptors.size(); ++i)
    if (descriptors[i]) described.push_back({i, *descriptors[i]});
  return described;
}

}  // namespace swiftlet::vision
