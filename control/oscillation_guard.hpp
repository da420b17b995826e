// Notices that roll and pitch swing, as they do where slow motors and the position controller together are near their
// stability limit, and takes the horizontal gains back until the swing has ended.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace swiftlet::control {

/// What counts is the RMS of roll and pitch above a slow mean. A manoeuvre tilts once and returns; a limit
/// cycle of 1 Hz or more repeats.
class OscillationGuard {
 public:
  /// Least share of the horizontal gains. Measured: docs/decisions/control.md#063.
  static constexpr double kLeastShare = 0.35;

  void reset();
  /// The attitude, in odom, at each tick in the air.
  void observe(const Eigen::Quaterniond& rotation_odom_body, double dt_s);
  /// The RMS of roll and pitch together around their mean.
  double swing_rad() const;
  /// The share of the horizontal gains to use, in (0, 1].
  double share() const { return share_; }

 private:
  std::optional<Eigen::Vector2d> mean_rad_;
  double square_rad2_ = 0.0;
  double share_ = 1.0;
};

}  // namespace swiftlet::control
