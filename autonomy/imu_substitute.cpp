#include "autonomy/imu_substitute.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;
using common::config::kPositive;

namespace {

/// The share of a step that a lag of first order lets through in that time.
double followed(double dt_s, double lag_s) { return lag_s > 0.0 ? 1.0 - std::exp(-dt_s / lag_s) : 1.0; }

}  // namespace

void ImuSubstituteConfig::describe(common::config::Fields& fields) {
  fields("attitude_lag_s", attitude_lag_s, {0.0, 1.0}, "Lag of roll and pitch behind their setpoints.");
  fields("thrust_lag_s", thrust_lag_s, {0.0, 0.5}, "Lag of the thrust behind its command.");
  fields("at_most_s", at_most_s, kPositive, "After this long nothing is predicted any more.");
}

void ImuSubstitute::measured(const ImuSample& sample) {
  last_ = sample;
  measured_ = sample.stamps.measured;
  delay_ = sample.stamps.arrived - sample.stamps.measured;
  force_over_gravity_ = thrust_over_hover_;
}

void ImuSubstitute::flown(const common::Setpoint& setpoint, double thrust_over_hover) {
  setpoint_ = setpoint;
  thrust_over_hover_ = thrust_over_hover;
}

std::optional<ImuSample> ImuSubstitute::next(Time now) {
  if (!last_) return std::nullopt;
  const Time measured = last_->stamps.measured + common::kControlPeriod;
  if (measured + delay_ > now || (measured - measured_).seconds() > config_.at_most_s) return std::nullopt;
  constexpr double kStep_s = common::kControlPeriod.seconds();
  common::RollPitchYaw attitude = common::rollPitchYaw(last_->rotation_ahrs_body);
  const double turned = followed(kStep_s, config_.attitude_lag_s);
  attitude.roll_rad += turned * (setpoint_.roll_rad - attitude.roll_rad);
  attitude.pitch_rad += turned * (setpoint_.pitch_rad - attitude.pitch_rad);
  attitude.yaw_rad = common::wrapAngle(attitude.yaw_rad + setpoint_.yaw_rate_rad_s * kStep_s);
  force_over_gravity_ += followed(kStep_s, config_.thrust_lag_s) * (thrust_over_hover_ - force_over_gravity_);

  ImuSample sample;
  sample.stamps = {measured, now};
  sample.rotation_ahrs_body = common::quaternionFrom(attitude);
  sample.angular_velocity_body_rad_s =
      common::logSO3(last_->rotation_ahrs_body.conjugate() * sample.rotation_ahrs_body) / kStep_s;
  sample.specific_force_body_m_s2 = {0.0, 0.0, force_over_gravity_ * control::kGravity_m_s2};
  last_ = sample;
  return sample;
}

}  // namespace swiftlet::autonomy
