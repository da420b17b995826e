// Notices that roll and pitch swing, as they do where slow motors and the position controller together are near their
// stability limit, and takes the horizontal gains back until the swing has ended.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/config_fwd.hpp"

namespace swiftlet::control {

/// What counts is the RMS of roll and pitch above a slow mean. A manoeuvre tilts once and returns; a limit
/// cycle of 1 Hz or more repeats.
class OscillationGuard {
 public:
  struct Config {
    static constexpr double mean_s = 0.2;  ///< Time constant of the mean that roll and pitch swing around.
    static constexpr double rms_s = 0.6;   ///< Time constant of the RMS of the swing of roll and pitch.
    static constexpr double calm_deg =
        5.0;  ///< RMS of the swing of roll and pitch up to which the horizontal gains are used in full (decision 063).
    static constexpr double least_share = 0.35;  ///< Least share of the horizontal gains.
    static constexpr double recovery_s = 4.0;    ///< Time constant with which the horizontal gains return.
  };

  explicit OscillationGuard(const Config& config) : config_(config) {}

  void reset();
  /// The attitude, in odom, at each tick in the air.
  void observe(const Eigen::Quaterniond& rotation_odom_body, double dt_s);
  /// The RMS of roll and pitch together around their mean.
  double swing_rad() const;
  /// The share of the horizontal gains to use, in (0, 1].
  double share() const { return share_; }

 private:
  Config config_;
  std::optional<Eigen::Vector2d> mean_rad_;
  double square_rad2_ = 0.0;
  double share_ = 1.0;
};

}  // namespace swiftlet::control
