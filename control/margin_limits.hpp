// How much of its speed and acceleration a vehicle may use with the thrust that it has left.
#pragma once

namespace swiftlet::control {

/// Accelerations shrink in proportion to the share, speeds to its root: so the distance to brake, v^2 / 2a, stays.
class MarginLimits {
 public:
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
  double share_ = 1.0;
  bool observed_ = false;
};

}  // namespace swiftlet::control
