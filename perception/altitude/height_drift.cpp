#include "perception/altitude/height_drift.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"
#include "perception/altitude/slope_limits.hpp"

namespace swiftlet::perception {
namespace {

using common::square;

/// Long enough for a rate of some cm/s from the noise below, and short enough that what drifts at half a metre per
/// second squared is noticed before it has drifted by 0.15 m.
constexpr double kWindow_s = 0.5;
constexpr std::size_t kLeastSamples = 5;  ///< The scans of the window, at ten scans a second.
/// The noise of the median distance down of one scan: a UTM-30LX has 0.01 m a beam.
constexpr double kNoise_m = 0.01;
/// More than that from scan to scan is no drift: at 10 scans a second it would be 0.6 m/s.
constexpr double kJump_m = 0.06;
/// Least rate, m/s, and how many times its standard deviation: gusts and the lag of the height filter give 0.05 m/s.
constexpr double kLeast_m_s = 0.15, kSigmas = 4.0;

}  // namespace

std::optional<HeightDriftRate> HeightDrift::add(common::Time time, const Eigen::Vector2d& place_odom_m, double below_m,
                                                double height_m) {
  const double difference_m = below_m - height_m;
  if (!std::isfinite(difference_m) || !place_odom_m.allFinite()) return std::nullopt;
  if (!samples_.empty() &&
      (time <= samples_.back().time || std::abs(difference_m - samples_.back().difference_m) > kJump_m))
    samples_.clear();
  samples_.push_back({time, place_odom_m, difference_m});
  while ((time - samples_.front().time).seconds() > kWindow_s) samples_.pop_front();
  const double seen_s = (time - samples_.front().time).seconds();
  if (samples_.size() < kLeastSamples || seen_s < 0.8 * kWindow_s) return std::nullopt;

  double mean_s = 0.0, mean_m = 0.0, moved_m = 0.0;
  const auto count = static_cast<double>(samples_.size());
  for (const Sample& sample : samples_) {
    mean_s += (sample.time - time).seconds() / count;
    mean_m += sample.difference_m / count;
    moved_m = std::max(moved_m, (sample.place_odom_m - place_odom_m).norm());
  }
  double spread_s2 = 0.0, product_m_s = 0.0;
  for (const Sample& sample : samples_) {
    const double off_s = (sample.time - time).seconds() - mean_s;
    spread_s2 += square(off_s);
    product_m_s += off_s * (sample.difference_m - mean_m);
  }
  const double rate_m_s = product_m_s / spread_s2, variance_m2_s2 = square(kNoise_m) / spread_s2;
  const double sloping_m_s = kSteepestGradient * moved_m / seen_s;
  if (std::abs(rate_m_s) < sloping_m_s + std::max(kLeast_m_s, kSigmas * std::sqrt(variance_m2_s2))) return std::nullopt;
  return HeightDriftRate{rate_m_s, variance_m2_s2 + square(sloping_m_s)};
}

}  // namespace swiftlet::perception
