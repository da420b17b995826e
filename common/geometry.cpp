#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::common {

Pose3 Pose3::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
  return {inverse_rotation, -(inverse_rotation * position_m)};
}

Pose3 Pose3::operator*(const Pose3& other) const {
  return {(rotation * other.rotation).normalized(), position_m + rotation * other.position_m};
}

Eigen::Vector3d Pose3::operator*(const Eigen::Vector3d& point) const { return position_m + rotation * point; }

RollPitchYaw rollPitchYaw(const Eigen::Quaterniond& q) {
  const double sin_pitch = std::clamp(2.0 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0);
  return {std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()), 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y())),
          std::asin(sin_pitch), yawOf(q)};
}

Eigen::Quaterniond quaternionFrom(const RollPitchYaw& angles) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angles.yaw_rad, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(angles.pitch_rad, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(angles.roll_rad, Eigen::Vector3d::UnitX()));
}

double yawOf(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

double cosTilt(const Eigen::Quaterniond& q) { return (q * Eigen::Vector3d::UnitZ()).z(); }

bool isFinite(const Pose3& pose) { return pose.position_m.allFinite() && pose.rotation.coeffs().allFinite(); }

Pose2 planar(const Pose3& pose) { return {pose.position_m.x(), pose.position_m.y(), yawOf(pose.rotation)}; }

Pose3 lifted(const Pose2& pose, double z_m) {
  return {quaternionFrom({0.0, 0.0, pose.yaw_rad}), {pose.x_m, pose.y_m, z_m}};
}

Eigen::Quaterniond expSO3(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  const double half = 0.5 * angle;
  const double scale = angle < 1e-8 ? 0.5 : std::sin(half) / angle;
  const Eigen::Vector3d v = scale * rotation_rad;
  return Eigen::Quaterniond(std::cos(half), v.x(), v.y(), v.z()).normalized();
}

Eigen::Vector3d logSO3(const Eigen::Quaterniond& rotation) {
  const Eigen::Quaterniond q = rotation.w() < 0.0 ? Eigen::Quaterniond(-rotation.coeffs()) : rotation;
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(n, q.w()) / n) * q.vec();
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace swiftlet::common
