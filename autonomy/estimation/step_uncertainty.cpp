#include "autonomy/estimation/step_uncertainty.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "common/small_matrices.hpp"

namespace swiftlet::autonomy {

std::optional<common::UnobservableMotion> unobservableMotion(const OdometryStep& step,
                                                             const common::Pose2& T_odom_body) {
  if (!step.measurement || !step.measurement->unobservable_motion) return std::nullopt;
  return common::turned(*step.measurement->unobservable_motion, T_odom_body.yaw_rad - step.measurement->pose.yaw_rad);
}

Eigen::Matrix3d StepUncertainty::add(const OdometryStep& step, const common::Pose2& T_odom_body,
                                     const Eigen::Matrix3d& covariance_odom) {
  return step.covariance +
         common::turned(unobserved(covariance_odom, unobservableMotion(step, T_odom_body)), -T_odom_body.yaw_rad);
}

Eigen::Matrix3d StepUncertainty::grown(const common::Pose2& T_odom_body, const Eigen::Matrix3d& covariance_odom) {
  const common::SymmetricEigen<3> change = common::symmetricEigen(Eigen::Matrix3d(covariance_odom - covariance_odom_));
  covariance_odom_ = covariance_odom;
  unobservable_odom_.reset();
  const Eigen::Matrix3d growth = change.vectors * change.values.cwiseMax(0.0).asDiagonal() * change.vectors.transpose();
  return common::turned(growth, -T_odom_body.yaw_rad);
}

/// By how much the filter's covariance has changed along what this scan does not show, or along what the scan before
/// did not show, which this one has corrected.
Eigen::Matrix3d StepUncertainty::unobserved(const Eigen::Matrix3d& covariance_odom,
                                            const std::optional<common::UnobservableMotion>& motion_odom) {
  const std::optional<common::UnobservableMotion> along = motion_odom ? motion_odom : unobservable_odom_;
  const Eigen::Matrix3d change = covariance_odom - covariance_odom_;
  covariance_odom_ = covariance_odom;
  unobservable_odom_ = motion_odom;
  if (!along) return Eigen::Matrix3d::Zero();
  const Eigen::RowVector3d share = common::shareAlong(*along);
  const double variance = std::abs((share * change * share.transpose()).value());
  return variance * along->change * along->change.transpose();
}

}  // namespace swiftlet::autonomy
