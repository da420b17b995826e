#include "control/emergency_descent.hpp"

#include <algorithm>
#include <cmath>

#include "common/gravity.hpp"
#include "common/square.hpp"

namespace swiftlet::control {

namespace {

/// Time constant of the alpha-beta filter of raw heights. Measured: docs/decisions/control.md#092.
constexpr double kFilterTime_s = 0.09;
constexpr double kJump_m = 0.15;      ///< A residual larger than this is a step of the ground.
constexpr double kForgotten_s = 1.0;  ///< At the speed of a descent the height is another by then.

/// Height above where the vehicle stood at which the ground counts as near.
constexpr double kTouchdownHeight_m = 0.25;
constexpr double kGain_1_s = 2.5;       ///< Vertical acceleration per error of the vertical speed.
constexpr double kIntegral_1_s2 = 0.8;  ///< Vertical acceleration per integrated error of the vertical speed.
constexpr double kMaxVerticalIntegral_m_s2 = 2.0;  ///< A hover command that is wrong by a fifth.
constexpr double kMaxAcceleration_m_s2 = 2.0;      ///< A fifth of the weight: leaves thrust for the attitude.
constexpr double kThrustLag_s = 0.10;              ///< From a setpoint to its thrust: link and motors.
/// Deceleration per last known velocity when no horizontal estimate is left.
constexpr double kBrake_1_s = 2.0;

/// For each second without a measured height the slow part of the descent begins this much higher: a bias of the
/// accelerometer of 0.02 m/s^2 makes an error of 1 m in ten seconds.
constexpr double kBlindMargin_per_s = 0.1;
/// Growth of the error of a speed that the thrust model carries: its hover command is good to about 1 % of gravity.
constexpr double kModelSpeed_m_s2 = 0.05;
/// Share of the wanted speed of a descent while the thrust model alone carries the speed: the model's error is
/// added to it.
constexpr double kModelShare = 0.6;

constexpr double kStill_m_s = 0.10;  ///< A descent is faster: only the ground explains less.
/// Less than this above where it stood before its flight the vehicle may be standing.
constexpr double kRestMargin_m = 0.08;
constexpr double kRest_s = 0.5;        ///< Low and still for this long the vehicle is on the ground.
constexpr double kBlindRest_s = 12.0;  ///< After a descent without a height for this long the motors stop.
/// Below this share of the wanted speed the vehicle does not sink as it should.
constexpr double kSinkingShare = 0.7;
/// If the height by the thrust model is this far below the ground, the model has missed the touch-down.
constexpr double kMissed_m = 0.3;
/// Rate at which thrust is taken away while a descent does not sink.
constexpr double kPush_m_s3 = 1.0;
/// Greatest downward push. A vehicle that does not follow it stands on the ground. Without inertial samples the push is
/// smaller, because a fall would not be noticed.
constexpr double kGreatestPush_m_s2 = 3.0, kUncertainPush_m_s2 = 0.4;

}  // namespace

void AlphaBetaFilter::update(const RawHeight& raw) {
  if (!std::isfinite(raw.height_m) || raw.height_m < 0.0) return;
  const double dt_s = (raw.stamp - stamp_).seconds();
  if (samples_ > 0 && dt_s <= 0.0) return;
  if (samples_ == 0 || dt_s > kForgotten_s) {
    stamp_ = raw.stamp;
    height_m_ = raw.height_m;
    velocity_m_s_ = 0.0;
    samples_ = 1;
    return;
  }
  const double predicted_m = height_m_ + velocity_m_s_ * dt_s;
  const double residual_m = raw.height_m - predicted_m;
  if (std::abs(residual_m) > jump_m_) {
    height_m_ = raw.height_m;
  } else {
    const double theta = std::exp(-dt_s / time_constant_s_);
    height_m_ = predicted_m + (1.0 - theta * theta) * residual_m;
    velocity_m_s_ += (1.0 - theta) * (1.0 - theta) / dt_s * residual_m;
  }
  stamp_ = raw.stamp;
  ++samples_;
}

EmergencyDescent::EmergencyDescent() : filter_(kFilterTime_s, kJump_m) {}

void EmergencyDescent::start(common::Time now, double standing_height_m, const Eigen::Vector2d& velocity_level_m_s,
                             const Eigen::Vector3d& trim_level_m_s2) {
  trim_level_m_s2_ = trim_level_m_s2.allFinite() ? trim_level_m_s2 : Eigen::Vector3d::Zero();
  velocity_left_m_s_ = velocity_level_m_s.allFinite() ? velocity_level_m_s : Eigen::Vector2d::Zero();
  last_seen_ = last_moving_ = last_fast_ = now;
  standing_height_m_ = standing_height_m;
  integral_m_s2_ = given_m_s2_ = pushed_m_s2_ = 0.0;
  touched_down_ = false;
  motion_ = {filter_.ready() ? filter_.height_m() : standing_height_m_, filter_.velocity_m_s()};
}

common::Setpoint EmergencyDescent::tick(common::Time now, double dt_s, const ThrustModel& thrust,
                                        const std::optional<VerticalMotion>& carried) {
  common::Setpoint setpoint;
  setpoint.stamp = now;
  setpoint.motors_on = !touched_down_;
  if (touched_down_) return setpoint;

  const Eigen::Vector2d braking_m_s2 = -kBrake_1_s * velocity_left_m_s_;
  const Eigen::Vector2d given_m_s2 = braking_m_s2 / std::max(1.0, braking_m_s2.norm() / kMaxAcceleration_m_s2);
  velocity_left_m_s_ += given_m_s2 * dt_s;
  const Eigen::Vector2d tilt_m_s2 = given_m_s2 + trim_level_m_s2_.head<2>();
  setpoint.pitch_rad = std::atan2(tilt_m_s2.x(), common::kGravity_m_s2);
  setpoint.roll_rad = std::atan2(-tilt_m_s2.y(), common::kGravity_m_s2);
  const bool sees = filter_.ready() && (now - filter_.stamp()).seconds() <= kBlindAfter_s;
  given_m_s2_ = sees ? seenAcceleration_m_s2(now, dt_s) : blindAcceleration_m_s2(now, dt_s, carried);
  setpoint.thrust = thrust.commandFor(given_m_s2_ + trim_level_m_s2_.z(), 1.0);
  return setpoint;
}

/// Near the ground is where the touch-down speed is reached in time: a vehicle that sinks faster than it should, and
/// is seen late, brakes higher up.
double EmergencyDescent::wantedVelocity_m_s(double margin_m, double age_s) const {
  const double sinks_m_s = std::max(0.0, -motion_.velocity_m_s);
  const double excess_m2_s2 = common::square(sinks_m_s) - common::square(kTouchdownDescent_m_s);
  const double brakes_m =
      sinks_m_s * (age_s + kFilterTime_s + kThrustLag_s) + 0.5 * excess_m2_s2 / kMaxAcceleration_m_s2;
  const bool low = motion_.height_m < standing_height_m_ + std::max(kTouchdownHeight_m, brakes_m) + margin_m;
  return low ? -kTouchdownDescent_m_s : -kDescent_m_s;
}

double EmergencyDescent::accelerationFor(double wanted_m_s, double dt_s) {
  const double error_m_s = wanted_m_s - motion_.velocity_m_s;
  integral_m_s2_ = std::clamp(integral_m_s2_ + kIntegral_1_s2 * error_m_s * dt_s, -kMaxVerticalIntegral_m_s2,
                              kMaxVerticalIntegral_m_s2);
  return std::clamp(kGain_1_s * error_m_s + integral_m_s2_, -kMaxAcceleration_m_s2, kMaxAcceleration_m_s2);
}

/// A table of glass, or the edges of a gap, carry the vehicle higher than the beams say. A vehicle that stays still
/// while more and more thrust is taken away stands, as in a blind descent.
double EmergencyDescent::seenAcceleration_m_s2(common::Time now, double dt_s) {
  last_seen_ = now;
  motion_ = {filter_.height_m(), filter_.velocity_m_s()};
  const bool still = std::abs(motion_.velocity_m_s) < kStill_m_s;
  if (!still) last_fast_ = now;
  const bool hangs = (now - last_fast_).seconds() >= kRest_s;
  const double step_m_s2 = kPush_m_s3 * dt_s;
  pushed_m_s2_ = std::clamp(pushed_m_s2_ + (hangs ? step_m_s2 : -2.0 * step_m_s2), 0.0, kGreatestPush_m_s2);
  const bool low = motion_.height_m < standing_height_m_ + kRestMargin_m;
  const bool may_stand = still && (low || pushed_m_s2_ >= kGreatestPush_m_s2);
  if (!may_stand) last_moving_ = now;
  touched_down_ = (now - last_moving_).seconds() >= kRest_s;
  return accelerationFor(wantedVelocity_m_s(0.0, (now - filter_.stamp()).seconds()), dt_s) - pushed_m_s2_;
}

/// A vehicle on the ground cannot follow less thrust. So while the carried speed does not sink as wanted, more and more
/// thrust is taken away: in the air the vehicle sinks then, on the ground it stays.
double EmergencyDescent::blindAcceleration_m_s2(common::Time now, double dt_s,
                                                const std::optional<VerticalMotion>& carried) {
  const double blind_s = (now - last_seen_).seconds();
  if (carried) {
    motion_ = *carried;
  } else {
    motion_.velocity_m_s += given_m_s2_ * dt_s;
    motion_.height_m += motion_.velocity_m_s * dt_s;
    integral_m_s2_ = 0.0;  // The model agrees with its own commands, so the integral has no error to correct.
  }
  // Faster by what the carried speed may be wrong, so that the vehicle sinks in any case.
  const double wrong_m_s = blind_s * (carried ? kCarriedSpeed_m_s2 : kModelSpeed_m_s2);
  const double share = carried ? 1.0 : kModelShare;
  const double wanted_m_s = share * wantedVelocity_m_s(kBlindMargin_per_s * blind_s, 0.0) - wrong_m_s;
  const bool sinks =
      carried ? motion_.velocity_m_s < kSinkingShare * wanted_m_s : motion_.height_m > standing_height_m_ - kMissed_m;
  const double step_m_s2 = kPush_m_s3 * dt_s;
  pushed_m_s2_ = std::clamp(pushed_m_s2_ + (sinks ? -2.0 * step_m_s2 : step_m_s2), 0.0, kGreatestPush_m_s2);
  if (!carried) pushed_m_s2_ = std::min(pushed_m_s2_, kUncertainPush_m_s2);
  const bool rests = carried && !sinks && pushed_m_s2_ >= kGreatestPush_m_s2;
  if (!rests) last_moving_ = now;
  touched_down_ = (now - last_moving_).seconds() >= kRest_s || blind_s > (carried ? 2.0 : 1.0) * kBlindRest_s;
  return accelerationFor(wanted_m_s, dt_s) - pushed_m_s2_;
}

}  // namespace swiftlet::control
