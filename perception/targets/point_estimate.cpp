#include "perception/targets/point_estimate.hpp"

#include <Eigen/LU>

namespace swiftlet::perception {

// The measured point is z = p + J b + n, with the shared errors b and the noise n of covariance R. The errors are
// e = p - estimate, with covariance P, and C is that of e with b.

PointEstimate::PointEstimate(const PointMeasurement& first, const SharedCovariance& shared)
    : point_m_(first.point_m),
      covariance_m2_(first.by_shared * shared * first.by_shared.transpose() + first.covariance_m2),
      with_shared_(-first.by_shared * shared),
      shared_(shared) {}

/// S = P + C J' + J C' + J B J' + R.
Eigen::Matrix3d PointEstimate::innovation(const PointMeasurement& m) const {
  const Eigen::Matrix3d cross = with_shared_ * m.by_shared.transpose();
  return covariance_m2_ + cross + cross.transpose() + m.by_shared * shared_ * m.by_shared.transpose() + m.covariance_m2;
}

double PointEstimate::distanceSquared(const PointMeasurement& measurement) const {
  const Eigen::Vector3d off_m = measurement.point_m - point_m_;
  return off_m.dot(innovation(measurement).inverse() * off_m);
}

/// K = (P + C J') / S; then e becomes (I - K) e - K J b - K n.
void PointEstimate::update(const PointMeasurement& m) {
  const Eigen::Matrix3d gain = (covariance_m2_ + with_shared_ * m.by_shared.transpose()) * innovation(m).inverse();
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - gain;
  point_m_ += gain * (m.point_m - point_m_);
  const Eigen::Matrix3d cross = rest * with_shared_ * m.by_shared.transpose() * gain.transpose();
  covariance_m2_ = rest * covariance_m2_ * rest.transpose() - cross - cross.transpose() +
                   gain * (m.by_shared * shared_ * m.by_shared.transpose() + m.covariance_m2) * gain.transpose();
  covariance_m2_ = 0.5 * (covariance_m2_ + covariance_m2_.transpose()).eval();
  with_shared_ = rest * with_shared_ - gain * m.by_shared * shared_;
}

}  // namespace swiftlet::perception
