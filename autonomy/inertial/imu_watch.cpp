#include "autonomy/inertial/imu_watch.hpp"

#include <algorithm>

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;

namespace {

/// Without a finite inertial sample for this long the sensor is silent: eight samples of the slowest that is flown,
/// at 100 Hz. The attitude is then predicted over 0.08 s, and errs by a degree at 12 deg/s.
constexpr double kSilent_s = 0.08;
/// Greatest age of the newest inertial sample, by its time of measurement.
constexpr double kLate_s = 0.1;
/// Samples, or attitudes alone, that are equal bit by bit for longer than this are repeated ones
/// (docs/decisions/fail_safes.md#036).
constexpr double kRepeats_s = 0.06;
/// Three coarse numbers may repeat for longer by chance than those of a whole sample.
constexpr double kAlone = 3.0;

}  // namespace

bool isFinite(const ImuSample& sample) {
  return sample.angular_velocity_body_rad_s.allFinite() && sample.specific_force_body_m_s2.allFinite() &&
         sample.rotation_ahrs_body.coeffs().allFinite();
}

void ImuWatch::add(const ImuSample& sample) {
  finite_ = isFinite(sample);
  if (!finite_) return;
  const bool first = !last_;
  if (first || sample.angular_velocity_body_rad_s != last_->angular_velocity_body_rad_s)
    rates_changed_ = sample.stamps.measured;
  if (first || sample.specific_force_body_m_s2 != last_->specific_force_body_m_s2)
    force_changed_ = sample.stamps.measured;
  if (first || sample.rotation_ahrs_body.coeffs() != last_->rotation_ahrs_body.coeffs())
    attitude_changed_ = sample.stamps.measured;
  last_ = sample;
}

bool ImuWatch::repeats() const {
  return last_ && (last_->stamps.measured - std::max(rates_changed_, force_changed_)).seconds() > kRepeats_s;
}

std::string_view ImuWatch::fault(Time now) const {
  if (!last_) return {};
  const common::Stamps& newest = last_->stamps;
  if ((now - newest.arrived).seconds() > kSilent_s)
    return finite_ ? "no inertial samples" : "the inertial samples are not finite";
  if ((now - newest.measured).seconds() > kLate_s) return "the inertial samples are late";
  if (repeats()) return "the inertial samples repeat";
  if ((newest.measured - attitude_changed_).seconds() > kRepeats_s) return "the attitude of the AHRS is frozen";
  if ((newest.measured - rates_changed_).seconds() > kAlone * kRepeats_s)
    return "the rates of the gyroscopes are frozen";
  if ((newest.measured - force_changed_).seconds() > kAlone * kRepeats_s)
    return "the forces of the accelerometers are frozen";
  return {};
}

}  // namespace swiftlet::autonomy
