// The number of particles that a belief needs (Fox 2003, "Adapting the sample size in particle filters through
// KLD-sampling").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Number of samples at which the Kullback-Leibler distance between the true distribution over `occupied_bins` bins and
/// the sampled one stays below `error`, with the probability whose upper standard normal quantile is `quantile`
/// (equation 7 there, the Wilson-Hilferty approximation).
inline double kldSampleSize(std::size_t occupied_bins, double error, double quantile) {
  if (occupied_bins < 2) return 1.0;
  const auto k = static_cast<double>(occupied_bins - 1);
  const double a = 2.0 / (9.0 * k);
  const double b = 1.0 - a + std::sqrt(a) * quantile;
  return k / (2.0 * error) * b * b * b;
}

/// The set of pose bins that contain at least one sample.
class PoseBins {
 public:
  PoseBins(double bin_m, double bin_rad) : bin_m_(bin_m), bin_rad_(bin_rad) {}

  void add(double x_m, double y_m, double yaw_rad) {
    const auto bin = [](double value, double width) {
      constexpr double kHalf = 1 << 20;
      const double at = std::floor(value / width) + kHalf;
      // NaN goes into bin 0.
      return at > 0.0 ? static_cast<std::uint64_t>(std::min(at, 2.0 * kHalf - 1.0)) : 0U;
    };
    bins_.insert(bin(x_m, bin_m_) << 42 | bin(y_m, bin_m_) << 21 | bin(yaw_rad, bin_rad_));
  }
  std::size_t occupied() const { return bins_.size(); }

 private:
  double bin_m_, bin_rad_;
  std::unordered_set<std::uint64_t> bins_;
};

}  // namespace swiftlet::perception
