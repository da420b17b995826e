#include "optimization/edge_error_3d.hpp"

namespace swiftlet::optimization {
namespace {

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

/// The vector part of a * b is leftVector(a) * b.coeffs().
Eigen::Matrix<double, 3, 4> leftVector(const Eigen::Quaterniond& a) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << a.w() * Eigen::Matrix3d::Identity() + cross(a.vec()), a.vec();
  return matrix;
}

/// The vector part of a * b is rightVector(b) * a.coeffs().
Eigen::Matrix<double, 3, 4> rightVector(const Eigen::Quaterniond& b) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << b.w() * Eigen::Matrix3d::Identity() - cross(b.vec()), b.vec();
  return matrix;
}

}  // namespace

EdgeError3D edgeError(const common::Pose3& from, const common::Pose3& to, const common::Pose3& T_from_to) {
  const Eigen::Quaterniond back = T_from_to.rotation.conjugate();
  const Eigen::Quaterniond turned = back * from.rotation.conjugate();
  const Eigen::Quaterniond difference = turned * to.rotation;
  const double sign = difference.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix3d R_back = back.toRotationMatrix(), R_turned = turned.toRotationMatrix();
  const Eigen::Vector3d step = to.position_m - from.position_m;

  EdgeError3D e;
  e.error << R_turned * step - R_back * T_from_to.position_m, sign * difference.vec();

  // With u, w of the rotation of `from`: R_from' * step = step - 2 w (u x step) + 2 u x (u x step).
  const Eigen::Vector3d u = from.rotation.vec();
  Eigen::Matrix<double, 3, 4> by_rotation;
  by_rotation << 2.0 * (from.rotation.w() * cross(step) + u.dot(step) * Eigen::Matrix3d::Identity() +
                        u * step.transpose() - 2.0 * step * u.transpose()),
      -2.0 * u.cross(step);

  const Eigen::Vector4d conjugation(-1.0, -1.0, -1.0, 1.0);
  e.jacobian_from.topLeftCorner<3, 3>() = -R_turned;
  e.jacobian_from.topRightCorner<3, 4>().noalias() = R_back * by_rotation;
  e.jacobian_from.bottomLeftCorner<3, 3>().setZero();
  // back * conjugate(from) * to, linear in `from`.
  Eigen::Matrix4d by_conjugate;
  const Eigen::Quaterniond& b = to.rotation;
  by_conjugate << rightVector(b), -b.x(), -b.y(), -b.z(), b.w();
  e.jacobian_from.bottomRightCorner<3, 4>().noalias() =
      sign * leftVector(back) * by_conjugate * conjugation.asDiagonal();
  e.jacobian_to.topLeftCorner<3, 3>() = R_turned;
  e.jacobian_to.topRightCorner<3, 4>().setZero();
  e.jacobian_to.bottomLeftCorner<3, 3>().setZero();
  e.jacobian_to.bottomRightCorner<3, 4>() = sign * leftVector(turned);
  return e;
}

}  // namespace swiftlet::optimization
