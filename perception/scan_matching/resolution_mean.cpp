#include "perception/scan_matching/resolution_mean.hpp"

#include <cmath>

#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

std::uint64_t ResolutionMean::blockScore(int x0, int y0, int k, int block) const {
  const std::vector<std::uint32_t>& window = scores_[static_cast<std::size_t>(k + kRotations)];
  std::uint64_t score = 0;
  for (int y = y0; y < y0 + block; ++y)
    for (int x = x0; x < x0 + block; ++x) score += window[windowIndex(x + kHalf, y + kHalf)];
  return score;
}

/// The best pose of a coarser level is the block with the best mean score. Blocks lie on the grid of the search, which
/// corresponds to a likelihood field of that resolution, sampled at that resolution.
Eigen::Vector3d ResolutionMean::bestOfLevel(const BestPose& best, int block) const {
  std::uint64_t top = 0;
  Eigen::Vector3d estimate = Eigen::Vector3d::Zero();
  for (int k = -kRotations; k <= kRotations; ++k) {
    if ((best.rotation + k) % block != 0) continue;
    for (int y0 = -kHalf; y0 + block - 1 <= kHalf; ++y0) {
      if ((best.y + y0) % block != 0) continue;
      for (int x0 = -kHalf; x0 + block - 1 <= kHalf; ++x0) {
        if ((best.x + x0) % block != 0) continue;
        const std::uint64_t score = blockScore(x0, y0, k, block);
        if (score <= top) continue;
        top = score;
        estimate = Eigen::Vector3d(x0 + 0.5 * (block - 1), y0 + 0.5 * (block - 1), k);
      }
    }
  }
  return estimate;
}

Eigen::Vector3d ResolutionMean::of(const BestPose& best, int levels, double resolution_m) const {
  // With a larger spread, the quantization of the coarse levels would outweigh the gain of averaging.
  const double spread_m = 0.5 * resolution_m;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (int level = 0; level < levels; ++level) {
    const Eigen::Vector3d estimate = bestOfLevel(best, 1 << level);
    const double distance_m = estimate.head<2>().norm() * resolution_m;
    const double weight = std::exp(-0.5 * distance_m * distance_m / (spread_m * spread_m));
    sum += weight * estimate;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace swiftlet::perception
