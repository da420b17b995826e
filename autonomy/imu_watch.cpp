#include "autonomy/imu_watch.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;
using common::config::kPositive;

void ImuWatchConfig::describe(common::config::Fields& fields) {
  fields("silent_s", silent_s, kPositive, "Greatest age of the newest inertial sample.");
  fields("repeats_s", repeats_s, kPositive,
         "Samples that are equal bit by bit for longer than this are repeated ones.");
  fields("ahrs_turn_deg", ahrs_turn_deg, kPositive,
         "An attitude that stays equal bit by bit while the gyroscopes turn by this much is that of a stopped AHRS.");
}

void ImuWatch::add(const ImuSample& sample) {
  const bool first = !last_;
  if (first || sample.angular_velocity_body_rad_s != last_->angular_velocity_body_rad_s ||
      sample.specific_force_body_m_s2 != last_->specific_force_body_m_s2)
    changed_ = sample.stamps.measured;
  if (first || sample.rotation_ahrs_body.coeffs() != last_->rotation_ahrs_body.coeffs()) {
    turned_rad_ = 0.0;
  } else {
    const double step_s = std::max(0.0, (sample.stamps.measured - last_->stamps.measured).seconds());
    const double rate_rad_s = sample.angular_velocity_body_rad_s.norm();
    if (std::isfinite(rate_rad_s)) turned_rad_ += rate_rad_s * step_s;
  }
  last_ = sample;
}

std::string ImuWatch::fault(Time now) const {
  if (!last_) return {};
  if ((now - last_->stamps.measured).seconds() > config_.silent_s) return "no inertial samples";
  if ((last_->stamps.measured - changed_).seconds() > config_.repeats_s) return "the inertial samples repeat";
  const bool gyroscopes_measure = changed_ == last_->stamps.measured;
  if (gyroscopes_measure && turned_rad_ > config_.ahrs_turn_deg * common::kRadPerDeg)
    return "the AHRS gives the same attitude";
  return {};
}

}  // namespace swiftlet::autonomy
