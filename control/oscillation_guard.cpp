#include "control/oscillation_guard.hpp"

#include <algorithm>
#include <cmath>

#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {

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
  // Down at once and up slowly: gains that return as soon as the swing has ended would start it again.
  share_ = share < share_ ? share : share_ + common::followedShare(dt_s, config_.recovery_s) * (share - share_);
}

double OscillationGuard::swing_rad() const { return std::sqrt(square_rad2_); }

}  // namespace swiftlet::control
