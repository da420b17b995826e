#include "common/pose2.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace swiftlet::common {

double wrapAngle(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

Pose2 Pose2::inverse() const {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {-c * x_m - s * y_m, s * x_m - c * y_m, wrapAngle(-yaw_rad)};
}

Pose2 Pose2::operator*(const Pose2& other) const {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {x_m + c * other.x_m - s * other.y_m, y_m + s * other.x_m + c * other.y_m, wrapAngle(yaw_rad + other.yaw_rad)};
}

Eigen::Vector2d Pose2::operator*(const Eigen::Vector2d& point) const {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {x_m + c * point.x() - s * point.y(), y_m + s * point.x() + c * point.y()};
}

bool isFinite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double yaw_rad) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  return rotation * covariance * rotation.transpose();
}

Eigen::Matrix3d withoutVarianceAlong(const std::optional<Eigen::Vector2d>& direction,
                                     const Eigen::Matrix3d& covariance) {
  if (!direction) return covariance;
  Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
  across.topLeftCorner<2, 2>() -= *direction * direction->transpose();
  return across * covariance * across;
}

Eigen::Matrix3d planarCovariance(double position_sigma_m, double yaw_sigma_rad) {
  const double position_m2 = position_sigma_m * position_sigma_m;
  return Eigen::Vector3d(position_m2, position_m2, yaw_sigma_rad * yaw_sigma_rad).asDiagonal();
}

Pose2 between(const Pose2& T_map_a, const Pose2& T_map_b) { return T_map_a.inverse() * T_map_b; }

Eigen::Matrix3d propagated(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to,
                           const Eigen::Matrix3d& step_covariance) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -(to.y_m - from.y_m);
  F(1, 2) = to.x_m - from.x_m;
  return F * covariance * F.transpose() + step_covariance;
}

}  // namespace swiftlet::common
