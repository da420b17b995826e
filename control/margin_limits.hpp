// How much of its speed and acceleration a vehicle may use with the thrust that it has left.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::control {

/// Accelerations shrink in proportion to the share, speeds to its root: so the distance to brake, v^2 / 2a, stays.
class MarginLimits {
 public:
  struct Config {
    static constexpr double full_margin =
        1.20;  ///< Greatest thrust over the weight from which on it does not limit speeds and accelerations.
    static constexpr double least_margin = 1.05;  ///< Greatest thrust over the weight at which, and below which,
                                                  ///< least_share of the accelerations is flown.
    static constexpr double least_share =
        0.35;  ///< Share of the accelerations that is flown at least_margin; the share of the speeds is its root.
    static constexpr double filter_s = 2.0;  ///< Time constant by which the limits follow the margin.
  };

  explicit MarginLimits(const Config& config) : config_(config) {}

  /// `margin` is the greatest thrust over the weight. The share follows it with the filter's lag; the first call places
  /// it.
  void observe(double margin, double dt_s);

  /// The share of the accelerations, in (0, 1].
  double acceleration() const { return share_; }
  /// The share of the speeds.
  double speed() const;

  /// The share without the lag.
  double shareAt(double margin) const;

 private:
  Config config_;
  double share_ = 1.0;
  bool observed_ = false;
};

}  // namespace swiftlet::control
