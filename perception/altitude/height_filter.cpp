#include "perception/altitude/height_filter.hpp"

#include <algorithm>

namespace swiftlet::perception::altitude {

void HeightFilter::start(common::Time time, double height_m, double height_variance_m2) {
  constexpr double kAtRest_m2_s2 = 1e-4;
  stamp_ = time;
  state_ << height_m, 0.0;
  covariance_ = Eigen::Vector2d(height_variance_m2, kAtRest_m2_s2).asDiagonal();
  reference_variance_m2_ = 0.0;
}

void HeightFilter::assume(const HeightState& prior) {
  stamp_ = prior.stamp;
  state_ << prior.height_m, prior.velocity_m_s;
  covariance_ = prior.covariance;
  // The variance of the reference is kept separately, so it is subtracted. The rest must not be less than the
  // correlation with the velocity implies.
  const double velocity_m2_s2 = covariance_(1, 1);
  const double explained_m2 = velocity_m2_s2 > 0.0 ? covariance_(0, 1) * covariance_(0, 1) / velocity_m2_s2 : 0.0;
  covariance_(0, 0) = std::max(covariance_(0, 0) - reference_variance_m2_, explained_m2);
}

void HeightFilter::correct(int component, double value, double variance) {
  const double innovation_variance = covariance_(component, component) + variance;
  const Eigen::Vector2d gain = covariance_.col(component) / innovation_variance;
  state_ += gain * (value - state_[component]);
  covariance_ -= innovation_variance * gain * gain.transpose();
}

void HeightFilter::takeReference(double own_variance_m2) {
  reference_variance_m2_ += covariance_(0, 0);
  covariance_.row(0).setZero();
  covariance_.col(0).setZero();
  covariance_(0, 0) = own_variance_m2;
}

void HeightFilter::dropReference() {
  covariance_(0, 0) += reference_variance_m2_;
  reference_variance_m2_ = 0.0;
}

Eigen::Matrix2d HeightFilter::covariance() const {
  Eigen::Matrix2d sum = covariance_;
  sum(0, 0) += reference_variance_m2_;
  return sum;
}

}  // namespace swiftlet::perception::altitude
