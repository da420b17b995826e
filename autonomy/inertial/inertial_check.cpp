#include "autonomy/inertial/inertial_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "autonomy/inertial/imu_substitute.hpp"
#include "autonomy/inertial/imu_watch.hpp"
#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;
using Eigen::Vector3d;

namespace {

/// Mean difference between the gyroscopes and the change of the AHRS' attitude from which they are not used, over
/// kRateWindow_s: a good gyroscope drifts by less than 1 deg/s, and an AHRS turns by its own error of about a degree
/// within the window.
constexpr double kRate_deg_s = 25.0;
constexpr double kRateWindow_s = 0.1;
/// Mean specific force along the rotors' axis beyond that of the given thrust from which the accelerometer is not used.
/// Less force than that means that the vehicle sinks.
constexpr double kAlong_m_s2 = 3.5;
constexpr double kAlongWindow_s = 0.05;
/// What contradicts the thrust for less time was a push: a hand's touch takes a tenth of a second.
constexpr double kLongestPush_s = 0.2;
/// Median specific force across the rotors' axis from which the accelerometer is not used: a tilt does not cause any,
/// only drag and pushes do.
constexpr double kAcross_m_s2 = 2.5;
/// More than twice the push of a hand, so that its median does not see the push.
constexpr double kAcrossWindow_s = 0.3;
constexpr double kPause_s = 0.1;  ///< After a pause the windows start over.
/// Of the longest window: an IMU at 1 kHz over 0.3 s fits. A faster one allocates until its windows are full.
constexpr std::size_t kUsualSamples = 320;

/// The mean of `value` over the newest samples of `window` that span `span_s`; nullopt if they do not span it yet.
template <typename Window, typename Value>
auto meanOver(const Window& window, double span_s, Value value) -> std::optional<decltype(value(window.back()))> {
  auto sum = value(window.back());
  const Time newest = window.back().sample.stamps.measured;
  int count = 1;
  for (auto it = std::next(window.rbegin()); it != window.rend(); ++it) {
    if ((newest - it->sample.stamps.measured).seconds() > span_s - 1e-6) return sum / count;
    sum += value(*it);
    ++count;
  }
  return std::nullopt;
}

}  // namespace

InertialCheck::InertialCheck() {
  window_.reserve(kUsualSamples);
  sorted_m_s2_.reserve(kUsualSamples);
}

ImuSample InertialCheck::checked(const ImuSample& sample) {
  if (!isFinite(sample)) return sample;
  const Time now = sample.stamps.measured;
  const bool continues = last_ && now > *last_ && (now - *last_).seconds() < kPause_s;
  const double dt_s = continues ? (now - *last_).seconds() : 0.0;
  const double expected_m_s2 = expectedForce_m_s2(now);
  last_ = now;
  if (!continues || !context_.airborne) window_.clear();
  if (!context_.airborne) {
    rates_wrong_.reset(), force_wrong_.reset(), pushed_.reset();
    fault_ = Fault::kNone;
    return sample;
  }
  window_.push_back({sample, expected_m_s2, context_.thrust_applies});
  const double longest_s = std::max({kRateWindow_s, kAlongWindow_s, kAcrossWindow_s});
  const auto kept = std::find_if(window_.begin(), window_.end(), [&](const Compared& one) {
    return (now - one.sample.stamps.measured).seconds() <= longest_s + 0.02;
  });
  window_.erase(window_.begin(), kept);
  fault_ = Fault::kNone;
  rates_wrong_.update(ratesDiffer(), now);
  const bool differ = forcesDiffer();
  if (force_wrong_.update(differ, now) == common::Edge::kEntered) withheld_m_s_.setZero();
  ImuSample used = sample;
  if (rates_wrong_.active()) used.angular_velocity_body_rad_s = ahrsRate_rad_s();
  if (!differ && dt_s > 0.0 && wasPush(now)) {
    used.specific_force_body_m_s2 += withheld_m_s_ / dt_s;
    pushed_ = now;
    force_wrong_.reset();
  } else if (force_wrong_.active()) {
    const Vector3d implied_m_s2(0.0, 0.0, context_.thrust_applies ? expected_m_s2 : common::kGravity_m_s2);
    withheld_m_s_ += dt_s * (sample.specific_force_body_m_s2 - implied_m_s2);
    // A replaced value is off by a few percent of gravity for seconds, which is worth this much noise.
    spread_m_s2_ = spread_m_s2_ > 0.0 ? -kImpliedSpread_m_s2 : kImpliedSpread_m_s2;
    used.specific_force_body_m_s2 = implied_m_s2 + Vector3d::Constant(spread_m_s2_);
  }
  return used;
}

/// Forces that contradict the thrust only for a moment, and not again and again, are those of a push.
bool InertialCheck::wasPush(Time now) const {
  const bool once = !pushed_ || (now - *pushed_).seconds() > kTrustedAgain_s;
  return once && force_wrong_.active() && force_wrong_.active_s(now) < kLongestPush_s;
}

bool InertialCheck::contradicted() const {
  return rates_wrong_.active() || (last_ && force_wrong_.active_s(*last_) >= kLongestPush_s);
}

/// The ground carries what the thrust leaves of the weight, and no more.
double InertialCheck::expectedForce_m_s2(Time now) {
  const double dt_s = last_ ? std::clamp((now - *last_).seconds(), 0.0, kPause_s) : 0.0;
  const double share = common::followedShare(dt_s, ImuSubstitute::kThrustLag_s);
  thrust_over_hover_ += share * (context_.thrust_over_hover - thrust_over_hover_);
  return common::kGravity_m_s2 * (context_.near_ground ? std::max(thrust_over_hover_, 1.0) : thrust_over_hover_);
}

/// Over the window of the rates, or as much of it as there is.
Vector3d InertialCheck::ahrsRate_rad_s() const {
  const ImuSample& newest = window_.back().sample;
  auto oldest = window_.rbegin();
  for (auto it = window_.rbegin(); it != window_.rend(); ++it) {
    oldest = it;
    if ((newest.stamps.measured - it->sample.stamps.measured).seconds() > kRateWindow_s - 1e-6) break;
  }
  const double span_s = (newest.stamps.measured - oldest->sample.stamps.measured).seconds();
  if (span_s <= 0.0) return Vector3d::Zero();
  const Eigen::AngleAxisd turned(oldest->sample.rotation_ahrs_body.conjugate() * newest.rotation_ahrs_body);
  return turned.angle() / span_s * turned.axis();
}

std::string InertialCheck::fault() const {
  if (!contradicted()) return {};
  switch (fault_) {
    case Fault::kRates:
      return fmt::format("the gyroscopes contradict the AHRS by {:.0f} deg/s", fault_size_);
    case Fault::kAcross:
      return fmt::format("the accelerometer contradicts the thrust by {:.1f} m/s^2 across its axis", fault_size_);
    case Fault::kAlong:
      return fmt::format("the accelerometer contradicts the thrust by {:.1f} m/s^2 along its axis", fault_size_);
    case Fault::kNone:
      break;
  }
  return rates_wrong_.active() ? "the gyroscopes contradicted the AHRS a moment ago"
                               : "the accelerometer contradicted the thrust a moment ago";
}

/// The median of a component across the rotors' axis over the newest samples that span kAcrossWindow_s: a push that is
/// shorter than half of that leaves it as it is. nullopt if the samples do not span it yet.
std::optional<double> InertialCheck::medianForce_m_s2(int component) {
  const Time newest = window_.back().sample.stamps.measured;
  if ((newest - window_.front().sample.stamps.measured).seconds() < kAcrossWindow_s - 1e-6) return std::nullopt;
  sorted_m_s2_.clear();
  for (auto it = window_.rbegin(); it != window_.rend(); ++it) {
    if ((newest - it->sample.stamps.measured).seconds() > kAcrossWindow_s - 1e-6) break;
    sorted_m_s2_.push_back(it->sample.specific_force_body_m_s2[component]);
  }
  const auto middle = sorted_m_s2_.begin() + static_cast<std::ptrdiff_t>(sorted_m_s2_.size() / 2);
  std::nth_element(sorted_m_s2_.begin(), middle, sorted_m_s2_.end());
  return *middle;
}

bool InertialCheck::ratesDiffer() {
  const auto mean = meanOver(window_, kRateWindow_s,
                             [](const Compared& one) { return Vector3d(one.sample.angular_velocity_body_rad_s); });
  if (!mean) return false;
  const double off_deg_s = (*mean - ahrsRate_rad_s()).norm() / common::kRadPerDeg;
  if (off_deg_s < kRate_deg_s) return false;
  fault_ = Fault::kRates;
  fault_size_ = off_deg_s;
  return true;
}

bool InertialCheck::forcesDiffer() {
  bool differ = false;
  const auto distrust = [&](double off_m_s2, Fault fault) {
    differ = true;
    fault_ = fault;
    fault_size_ = off_m_s2;
  };
  const auto x = medianForce_m_s2(0), y = medianForce_m_s2(1);
  if (x && y && std::hypot(*x, *y) > kAcross_m_s2) distrust(std::hypot(*x, *y), Fault::kAcross);
  const bool known = std::all_of(window_.begin(), window_.end(), [](const Compared& one) { return one.known; });
  if (!known) return differ;
  const auto along = meanOver(window_, kAlongWindow_s, [](const Compared& one) {
    return one.sample.specific_force_body_m_s2.z() - one.expected_m_s2;
  });
  // Less force than the thrust gives means a sinking vehicle, by a weak motor or battery. More force is impossible.
  if (along && *along > kAlong_m_s2) distrust(*along, Fault::kAlong);
  return differ;
}

}  // namespace swiftlet::autonomy
