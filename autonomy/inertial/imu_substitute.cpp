#include "autonomy/inertial/imu_substitute.hpp"

#include <Eigen/Geometry>

#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;

namespace {

/// Twice what an emergency descent from the greatest height, 2 m, takes.
constexpr double kLongest_s = 15.0;

}  // namespace

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
  if (measured + delay_ > now || (measured - measured_).seconds() > kLongest_s) return std::nullopt;
  constexpr double kStep_s = common::kControlPeriod.seconds();
  common::RollPitchYaw attitude = common::rollPitchYaw(last_->rotation_ahrs_body);
  const double turned = common::followedShare(kStep_s, attitude_lag_s_);
  attitude.roll_rad += turned * (setpoint_.roll_rad - attitude.roll_rad);
  attitude.pitch_rad += turned * (setpoint_.pitch_rad - attitude.pitch_rad);
  attitude.yaw_rad = common::wrapAngle(attitude.yaw_rad + setpoint_.yaw_rate_rad_s * kStep_s);
  force_over_gravity_ += common::followedShare(kStep_s, kThrustLag_s) * (thrust_over_hover_ - force_over_gravity_);

  ImuSample sample;
  sample.stamps = {measured, now};
  sample.rotation_ahrs_body = common::quaternionFrom(attitude);
  sample.angular_velocity_body_rad_s =
      common::logSO3(last_->rotation_ahrs_body.conjugate() * sample.rotation_ahrs_body) / kStep_s;
  sample.specific_force_body_m_s2 = {0.0, 0.0, force_over_gravity_ * common::kGravity_m_s2};
  last_ = sample;
  return sample;
}

}  // namespace swiftlet::autonomy
