// The mean of the best poses of several resolutions, weighted by a Gaussian about the finest (Grzonka 2012, IV-A).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "perception/scan_matching/branch_and_bound.hpp"

namespace swiftlet::perception {

/// Computed from the scores of the finest level around the best pose of the search.
class ResolutionMean {
 public:
  static constexpr int kHalf = 7;       ///< Cells on either side of the best pose.
  static constexpr int kRotations = 4;  ///< Rotation steps on either side of the best pose.

  /// To be filled in for each rotation k from -kRotations to kRotations, in the order of sumWindows: rows and columns
  /// from -kHalf to kHalf.
  std::vector<std::uint32_t>& scores(int k) { return scores_[static_cast<std::size_t>(k + kRotations)]; }

  /// Offset of the mean from the best pose of the finest level, in (cells, cells, rotation steps). There are `levels`
  /// resolutions, each half as fine as the one before; the finest has cells of `resolution_m`.
  Eigen::Vector3d of(const BestPose& best, int levels, double resolution_m) const;

 private:
  Eigen::Vector3d bestOfLevel(const BestPose& best, int block) const;
  std::uint64_t blockScore(int x0, int y0, int k, int block) const;

  std::array<std::vector<std::uint32_t>, 2 * kRotations + 1> scores_;
};

}  // namespace swiftlet::perception
