#include "perception/altitude/height_filter.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception::altitude {
namespace {
constexpr std::size_t kRing = 512;  ///< 2.5 s at 200 Hz: later scans find a shorter stretch.
}

HeightFilter::HeightFilter(double acceleration_noise_m_s2, double max_prediction_s)
    : acceleration_noise_m_s2_(acceleration_noise_m_s2), max_prediction_s_(max_prediction_s), ring_(kRing) {}

void HeightFilter::start(common::Time time, double height_m, double height_variance_m2) {
  stamp_ = time;
  state_ = {height_m, 0.0};
  covariance_ << height_variance_m2, 0.0, 0.0, 1e-4;
  count_ = 0;
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
  const double considered_s = std::min(whole_s, max_prediction_s_);
  common::Time at = time - common::Duration::fromSeconds(considered_s);
  double last_m_s2 = 0.0;
  while (count_ > 0) {
    const Acceleration& next = ring_[first_];
    last_m_s2 = next.up_m_s2;
    if (next.stamp > time) break;  // Kept: the next scan needs it again.
    if (next.stamp > at) {
      predict((next.stamp - at).seconds(), next.up_m_s2);
      at = next.stamp;
    }
    first_ = (first_ + 1) % kRing;
    --count_;
  }
  if (at < time) predict((time - at).seconds(), last_m_s2);
  // One error for the whole stretch: accelerometer noise is white, what hurts is a wrong horizon and a wrong bias.
  const Eigen::Vector2d effect(0.5 * whole_s * whole_s, whole_s);
  covariance_ += acceleration_noise_m_s2_ * acceleration_noise_m_s2_ * effect * effect.transpose();
  stamp_ = time;
}

void HeightFilter::predict(double dt_s, double acceleration_up_m_s2) {
  Eigen::Matrix2d a;
  a << 1.0, dt_s, 0.0, 1.0;
  state_ = a * state_ + Eigen::Vector2d(0.5 * dt_s * dt_s, dt_s) * acceleration_up_m_s2;
  covariance_ = a * covariance_ * a.transpose();
}

double HeightFilter::update(double height_m, double variance_m2) {
  const double innovation_variance = covariance_(0, 0) + variance_m2;
  const Eigen::Vector2d gain = covariance_.col(0) / innovation_variance;
  state_ += gain * (height_m - state_[0]);
  covariance_ -= innovation_variance * gain * gain.transpose();
  return innovation_variance;
}

void HeightFilter::keepVarianceAbove(double variance_m2) {
  covariance_(0, 0) = std::max(covariance_(0, 0), variance_m2);
}

}  // namespace swiftlet::perception::altitude
