#include "perception/altitude/height_filter.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception::altitude {
namespace {
constexpr double kBias_m_s2 = 0.08;      ///< Initial bias: the part of gravity that a wrong roll or pitch leaves.
constexpr double kBiasWalk_m_s2 = 0.01;  ///< Per square root of a second.
constexpr double kRecall_s = 0.15;       ///< recall() goes back by once to twice this time.
constexpr std::size_t kRing = 512;       ///< 2.5 s at 200 Hz. With later scans, part of the interval is missing.
/// In a longer gap between scans only the last 0.5 s are predicted; the noise covers the whole gap.
constexpr double kMaxPrediction_s = 0.5;
}  // namespace

HeightFilter::HeightFilter(double acceleration_noise_m_s2)
    : acceleration_noise_m_s2_(acceleration_noise_m_s2), ring_(kRing) {}

void HeightFilter::start(common::Time time, double height_m, double height_variance_m2) {
  stamp_ = time;
  now_.updated = time;
  now_.state = {height_m, 0.0, 0.0};
  now_.covariance = Eigen::Vector3d(height_variance_m2, 1e-4, kBias_m_s2 * kBias_m_s2).asDiagonal();
  before_ = long_before_ = now_;
  count_ = 0;
  reference_variance_m2_ = 0.0;
}

void HeightFilter::addAcceleration(common::Time time, double acceleration_up_m_s2) {
  if (!std::isfinite(acceleration_up_m_s2)) return;
  if (count_ > 0 && time <= ring_[(first_ + count_ - 1) % kRing].stamp) return;
  if (count_ == kRing) {
    first_ = (first_ + 1) % kRing;
    --count_;
  }
  ring_[(first_ + count_++) % kRing] = {time, acceleration_up_m_s2};
}

void HeightFilter::predictTo(common::Time time) {
  const double whole_s = (time - stamp_).seconds();
  const double considered_s = std::min(whole_s, kMaxPrediction_s);
  common::Time at = time - common::Duration::fromSeconds(considered_s);
  double last_m_s2 = 0.0;
  while (count_ > 0) {
    const Acceleration& next = ring_[first_];
    last_m_s2 = next.up_m_s2;
    if (next.stamp > time) break;  // Kept, because the next scan needs it again.
    if (next.stamp > at) {
      predict((next.stamp - at).seconds(), next.up_m_s2);
      at = next.stamp;
    }
    first_ = (first_ + 1) % kRing;
    --count_;
  }
  if (at < time) predict((time - at).seconds(), last_m_s2);
  // One constant error for the whole interval: the white noise of the accelerometer matters less than a wrong roll,
  // pitch or bias.
  const Eigen::Vector3d effect(0.5 * whole_s * whole_s, whole_s, 0.0);
  for (Belief* belief : {&now_, &before_, &long_before_}) {
    belief->covariance += acceleration_noise_m_s2_ * acceleration_noise_m_s2_ * effect * effect.transpose();
    belief->covariance(2, 2) += kBiasWalk_m_s2 * kBiasWalk_m_s2 * whole_s;
  }
  stamp_ = time;
}

void HeightFilter::predict(double dt_s, double acceleration_up_m_s2) {
  Eigen::Matrix3d a;
  a << 1.0, dt_s, -0.5 * dt_s * dt_s, 0.0, 1.0, -dt_s, 0.0, 0.0, 1.0;
  for (Belief* belief : {&now_, &before_, &long_before_}) {
    belief->state = a * belief->state + Eigen::Vector3d(0.5 * dt_s * dt_s, dt_s, 0.0) * acceleration_up_m_s2;
    belief->covariance = a * belief->covariance * a.transpose();
  }
}

void HeightFilter::assume(common::Time time, double height_m, double velocity_m_s, const Eigen::Matrix2d& covariance) {
  stamp_ = now_.updated = time;
  now_.state << height_m, velocity_m_s, 0.0;
  now_.covariance.setZero();
  now_.covariance.topLeftCorner<2, 2>() = covariance;
  // The variance of the reference is kept separately, so it is subtracted. The rest must not be less than the
  // correlation with the velocity implies.
  const double explained_m2 = covariance(1, 1) > 0.0 ? covariance(0, 1) * covariance(0, 1) / covariance(1, 1) : 0.0;
  now_.covariance(0, 0) = std::max(covariance(0, 0) - reference_variance_m2_, explained_m2);
  before_ = long_before_ = now_;
}

void HeightFilter::update(double height_m, double variance_m2) { correct(0, height_m, variance_m2); }
void HeightFilter::updateVelocity(double velocity_m_s, double variance_m2_s2) {
  correct(1, velocity_m_s, variance_m2_s2);
}

void HeightFilter::correct(int component, double value, double variance) {
  if ((stamp_ - before_.updated).seconds() >= kRecall_s) {
    long_before_ = before_;
    before_ = now_;
  }
  const double innovation_variance = now_.covariance(component, component) + variance;
  const Eigen::Vector3d gain = now_.covariance.col(component) / innovation_variance;
  now_.updated = stamp_;
  now_.state += gain * (value - now_.state[component]);
  now_.covariance -= innovation_variance * gain * gain.transpose();
}

void HeightFilter::takeReference(double own_variance_m2) {
  reference_variance_m2_ += now_.covariance(0, 0);
  now_.covariance.row(0).setZero();
  now_.covariance.col(0).setZero();
  now_.covariance(0, 0) = own_variance_m2;
}

void HeightFilter::dropReference() {
  now_.covariance(0, 0) += reference_variance_m2_;
  reference_variance_m2_ = 0.0;
}

void HeightFilter::recall() { now_ = before_ = long_before_; }

Eigen::Matrix2d HeightFilter::covariance() const {
  Eigen::Matrix2d sum = now_.covariance.topLeftCorner<2, 2>();
  sum(0, 0) += reference_variance_m2_;
  return sum;
}

}  // namespace swiftlet::perception::altitude
