#include "control/oscillation_guard.hpp"

#include <algorithm>
#include <cmath>

#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

constexpr double kMean_s = 0.2;  ///< Time constant of the mean that roll and pitch swing around.
constexpr double kRms_s = 0.6;   ///< Time constant of the RMS of the swing of roll and pitch.
/// RMS of the swing of roll and pitch up to which the horizontal gains are used in full. Measured:
/// docs/decisions/control.md#063: 4.1 to 5.4 deg at most in flights that end well.
constexpr double kCalm_rad = 5.0 * common::kRadPerDeg;
constexpr double kRecovery_s = 4.0;  ///< Time constant with which the horizontal gains return.

}  // namespace

void OscillationGuard::reset() {
  mean_rad_.reset();
  square_rad2_ = 0.0;
  share_ = 1.0;
}

void OscillationGuard::observe(const Eigen::Quaterniond& rotation_odom_body, double dt_s) {
  const common::RollPitchYaw attitude = common::rollPitchYaw(rotation_odom_body);
  const Eigen::Vector2d tilt_rad(attitude.roll_rad, attitude.pitch_rad);
  if (!mean_rad_) mean_rad_ = tilt_rad;
  *mean_rad_ += common::followedShare(dt_s, kMean_s) * (tilt_rad - *mean_rad_);
  square_rad2_ += common::followedShare(dt_s, kRms_s) * ((tilt_rad - *mean_rad_).squaredNorm() - square_rad2_);
  const double share = std::clamp(kCalm_rad / std::max(swing_rad(), 1e-9), kLeastShare, 1.0);
  // Down at once and up slowly: gains that return as soon as the swing has ended would start it again.
  share_ = share < share_ ? share : share_ + common::followedShare(dt_s, kRecovery_s) * (share - share_);
}

double OscillationGuard::swing_rad() const { return std::sqrt(square_rad2_); }

}  // namespace swiftlet::control
