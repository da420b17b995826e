#include "control/oscillation_guard.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {

using common::config::kPositive;

void OscillationGuard::reset() {
  mean_rad_.reset();
  square_rad2_ = 0.0;
  share_ = 1.0;
}

void OscillationGuard::observe(const Eigen::Quaterniond& rotation_odom_body, double dt_s) {
  const common::RollPitchYaw attitude = common::rollPitchYaw(rotation_odom_body);
  const Eigen::Vector2d tilt_rad(attitude.roll_rad, attitude.pitch_rad);
  if (!mean_rad_) mean_rad_ = tilt_rad;
  *mean_rad_ += common::followedShare(dt_s, config_.mean_s) * (tilt_rad - *mean_rad_);
  square_rad2_ += common::followedShare(dt_s, config_.rms_s) * ((tilt_rad - *mean_rad_).squaredNorm() - square_rad2_);
  const double calm_rad = config_.calm_deg * common::kRadPerDeg;
  const double share = std::clamp(calm_rad / std::max(swing_rad(), 1e-9), config_.least_share, 1.0);
  // Down at once and up slowly: gains that return as soon as the swing has ended would begin it anew.
  share_ = share < share_ ? share : share_ + common::followedShare(dt_s, config_.recovery_s) * (share - share_);
}

double OscillationGuard::swing_rad() const { return std::sqrt(square_rad2_); }

void OscillationGuard::Config::describe(common::config::Fields& fields) {
  fields("mean_s", mean_s, kPositive, "Time constant of the mean that roll and pitch swing around.");
  fields("rms_s", rms_s, kPositive, "Time constant of the RMS of the swing of roll and pitch.");
  fields("calm_deg", calm_deg, {0.5, 45},
         "RMS of the swing of roll and pitch up to which the horizontal gains are used in full (decision 063).");
  fields("least_share", least_share, {0.05, 1}, "Least share of the horizontal gains.");
  fields("recovery_s", recovery_s, kPositive, "Time constant with which the horizontal gains return.");
}

}  // namespace swiftlet::control
