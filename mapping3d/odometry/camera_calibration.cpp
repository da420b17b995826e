#include "mapping3d/odometry/camera_calibration.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using Eigen::Vector3d;

constexpr int kRoll = 3, kYaw = 5, kClock = 6;
/// Standard deviations at the start: of the mount's position along each axis, and of the clock's offset.
constexpr double kMountSigma_m = 0.01, kClockSigma_s = 0.005;
/// Random walk of the clock's offset, as two clocks drift apart.
constexpr double kClockWalk_s_rts = 0.0002;
/// Standard deviations of the body's motion between two key frames as the other sensors measure it: of its position and
/// of its rotation, about each axis.
constexpr double kBodySigma_m = 0.006, kBodySigma_rad = 0.003;
/// A component is used once its standard deviation has shrunk to this part of that of the start
/// (docs/decisions/cameras_and_lasers.md#039).
constexpr double kKnownShare = 0.5;

/// From errors of the camera's pose to those of the body's, each in its own axes.
Matrix6d ofBody(const Matrix6d& covariance_camera, const Pose3& T_body_camera) {
  const Eigen::Matrix3d rotation = T_body_camera.rotation.toRotationMatrix();
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = rotation;
  adjoint.topRightCorner<3, 3>() = common::skew(T_body_camera.position_m) * rotation;
  return adjoint * covariance_camera * adjoint.transpose();
}

/// From the body at its time to where it was when the frame was taken, if the camera's clock has this offset.
Pose3 correctionOf(const MovingBody& body, double clock_offset_s) {
  const double earlier_s = clock_offset_s - body.clock_offset_s;
  return {common::expSO3(-earlier_s * body.rate_body_rad_s), -earlier_s * body.velocity_body_m_s};
}

}  // namespace

CameraCalibration::CameraCalibration(const CameraCalibrationConfig& config, const Pose3& T_body_camera_sheet)
    : config_(config), T_body_camera_sheet_(T_body_camera_sheet) {
  prior_sigma_ << Vector3d::Constant(kMountSigma_m), Vector3d::Constant(kMountSigma_rad), kClockSigma_s;
  errors_.covariance = prior_sigma_.cwiseAbs2().asDiagonal();
}

void CameraCalibration::add(const CameraMotion& motion) {
  if (!config_.enabled) return;
  letClockDrift(motion.to.time);
  const Vector6d residual_0 = residual(motion, errors_.mean);
  const Jacobian H = jacobian(motion, errors_.mean);
  Matrix6d noise = ofBody(motion.covariance, mountWith(errors_.mean));
  noise.diagonal().head<3>().array() += kBodySigma_m * kBodySigma_m;
  noise.diagonal().tail<3>().array() += kBodySigma_rad * kBodySigma_rad;
  const Matrix6d innovation = H * errors_.covariance * H.transpose() + noise;
  const Eigen::LLT<Matrix6d> solver(innovation);
  if (!residual_0.allFinite() || !H.allFinite() || solver.info() != Eigen::Success) return;
  if (residual_0.dot(solver.solve(residual_0)) > 6.0 * config_.gate_sigma * config_.gate_sigma) return;
  const Eigen::Matrix<double, 7, 6> gain = solver.solve(H * errors_.covariance).transpose();
  errors_.mean -= gain * residual_0;
  const CameraErrors::Matrix7d reduced = errors_.covariance - gain * H * errors_.covariance;
  errors_.covariance = 0.5 * (reduced + reduced.transpose());
}

/// Never less certain than at the start.
void CameraCalibration::letClockDrift(common::Time now) {
  const double passed_s = newest_ ? std::max(0.0, (now - *newest_).seconds()) : 0.0;
  newest_ = now;
  const double most = prior_sigma_[kClock] * prior_sigma_[kClock];
  double& variance = errors_.covariance(kClock, kClock);
  variance = std::min(variance + kClockWalk_s_rts * kClockWalk_s_rts * passed_s, std::max(most, variance));
}

bool CameraCalibration::isKnown(int component) const {
  return std::sqrt(errors_.covariance(component, component)) <= kKnownShare * prior_sigma_[component];
}

CameraErrors::Vector7d CameraCalibration::used() const {
  CameraErrors::Vector7d used = CameraErrors::Vector7d::Zero();
  for (int i = kRoll; i < used.size(); ++i) {
    const double limit = kLimitSigma * prior_sigma_[i];
    if (isKnown(i)) used[i] = std::clamp(errors_.mean[i], -limit, limit);
  }
  return used;
}

Pose3 CameraCalibration::T_body_camera() const { return mountWith(used()); }

double CameraCalibration::clockOffset_s() const { return used()[kClock]; }

Pose3 CameraCalibration::bodyMotion(const Pose3& T_from_to_camera) const {
  const Pose3 T = T_body_camera();
  return T * T_from_to_camera * T.inverse();
}

Matrix6d CameraCalibration::bodyCovariance(const CameraMotion& motion) const {
  const CameraErrors::Vector7d at = used();
  const Jacobian H = jacobian(motion, at);
  CameraErrors::Matrix7d spread = errors_.covariance;
  if (!config_.enabled) spread.setZero();
  const Matrix6d covariance = ofBody(motion.covariance, mountWith(at)) + H * spread * H.transpose();
  return 0.5 * (covariance + covariance.transpose());
}

Pose3 CameraCalibration::mountWith(const CameraErrors::Vector7d& errors) const {
  return {common::expSO3(errors.segment<3>(3)) * T_body_camera_sheet_.rotation,
          T_body_camera_sheet_.position_m + errors.head<3>()};
}

/// By how much the body's motion that the camera measured differs from that of the other sensors, in the axes of the
/// body at `to`.
CameraCalibration::Vector6d CameraCalibration::residual(const CameraMotion& motion,
                                                        const CameraErrors::Vector7d& errors) const {
  const Pose3 moved = correctionOf(motion.from, errors[kClock]).inverse() * motion.T_from_to_body *
                      correctionOf(motion.to, errors[kClock]);
  const Pose3 T_body_camera = mountWith(errors);
  const Pose3 error = moved.inverse() * T_body_camera * motion.T_from_to_camera * T_body_camera.inverse();
  Vector6d residual;
  residual << error.position_m, common::logSO3(error.rotation);
  return residual;
}

/// By differences. Rotations determine the mount's yaw against the gyroscopes and translations against the laser,
/// whose own mount may be turned. The map has the laser's axes, so only translations count.
CameraCalibration::Jacobian CameraCalibration::jacobian(const CameraMotion& motion,
                                                        const CameraErrors::Vector7d& at) const {
  Jacobian jacobian;
  for (int i = 0; i < at.size(); ++i) {
    const double step = 0.1 * prior_sigma_[i];
    CameraErrors::Vector7d more = at, less = at;
    more[i] += step;
    less[i] -= step;
    jacobian.col(i) = (residual(motion, more) - residual(motion, less)) / (2.0 * step);
  }
  jacobian.col(kYaw).tail<3>().setZero();
  return jacobian;
}

}  // namespace swiftlet::mapping3d
