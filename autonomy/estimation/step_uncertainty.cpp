#include "autonomy/estimation/step_uncertainty.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::autonomy {

std::optional<Eigen::Vector2d> unobservableDirection(const OdometryStep& step, const common::Pose2& T_odom_body) {
  if (!step.measurement || !step.measurement->unobservable_direction) return std::nullopt;
  const double yaw_rad = T_odom_body.yaw_rad - step.measurement->pose.yaw_rad;
  return Eigen::Rotation2Dd(yaw_rad) * *step.measurement->unobservable_direction;
}

Eigen::Matrix3d StepUncertainty::add(const OdometryStep& step, const common::Pose2& T_odom_body,
                                     const Eigen::Matrix2d& covariance_odom_m2) {
  Eigen::Matrix3d unobserved = Eigen::Matrix3d::Zero();
  unobserved.topLeftCorner<2, 2>() = unobserved_m2(covariance_odom_m2, unobservableDirection(step, T_odom_body));
  return step.covariance + common::turned(unobserved, -T_odom_body.yaw_rad);
}

/// By how much the filter's covariance has changed along the direction of this scan, or along that of the scans before,
/// which this scan has corrected.
Eigen::Matrix2d StepUncertainty::unobserved_m2(const Eigen::Matrix2d& covariance_odom_m2,
                                               const std::optional<Eigen::Vector2d>& direction_odom) {
  const std::optional<Eigen::Vector2d> along = direction_odom ? direction_odom : direction_odom_;
  const Eigen::Matrix2d change_m2 = covariance_odom_m2 - covariance_odom_m2_;
  covariance_odom_m2_ = covariance_odom_m2;
  direction_odom_ = direction_odom;
  if (!along) return Eigen::Matrix2d::Zero();
  return std::abs(along->dot(change_m2 * *along)) * *along * along->transpose();
}

}  // namespace swiftlet::autonomy
