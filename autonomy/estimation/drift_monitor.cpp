#include "autonomy/estimation/drift_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "common/small_matrices.hpp"

namespace swiftlet::autonomy {
namespace {

/// What is left of a difference of covariances when no direction may shrink.
Eigen::Matrix2d positivePart(const Eigen::Matrix2d& difference_m2) {
  const common::SymmetricEigen<2> eigen = common::symmetricEigen(difference_m2);
  return eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
}

double greatestSigma_m(const Eigen::Matrix2d& covariance_m2) {
  return std::sqrt(std::max(0.0, common::symmetricEigenvalues(covariance_m2)(1)));
}

}  // namespace

double DriftMonitor::add(const PositionFix& fix) {
  const bool fixed = fix.matched && !fix.unobservable_direction_odom;
  held_.update(fixed, fix.stamp);
  if (held_.active()) {
    recall(fix.known_key);
    drift_m2_ = reference_drift_m2_;
  } else if (!fixed) {
    drift_m2_ = reference_drift_m2_ + grownSince(fix);
  }
  const bool gathers = fix.new_reference && !fix.turns;
  if (fixed || gathers) covariance_m2_ = fix.covariance_odom_m2;
  if (gathers) reference_drift_m2_ = drift_m2_;
  while (static_cast<int>(key_drift_m2_.size()) <= fix.newest_key) key_drift_m2_.push_back(drift_m2_);
  return greatestSigma_m(drift_m2_);
}

/// The growth of the filter's covariance, in the directions that the scan does not fix.
Eigen::Matrix2d DriftMonitor::grownSince(const PositionFix& fix) const {
  const Eigen::Matrix2d difference_m2 = fix.covariance_odom_m2 - covariance_m2_;
  if (!fix.matched) return positivePart(difference_m2);
  const Eigen::Vector2d& along = *fix.unobservable_direction_odom;
  return std::max(0.0, along.dot(difference_m2 * along)) * along * along.transpose();
}

/// A scan that was matched to an earlier key scan is as uncertain as that one.
void DriftMonitor::recall(int key) {
  if (key < 0 || key >= static_cast<int>(key_drift_m2_.size())) return;
  const Eigen::Matrix2d& then_m2 = key_drift_m2_[static_cast<std::size_t>(key)];
  if (then_m2.trace() < reference_drift_m2_.trace()) reference_drift_m2_ = then_m2;
}

}  // namespace swiftlet::autonomy
