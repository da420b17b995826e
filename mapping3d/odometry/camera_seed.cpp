#include "mapping3d/odometry/camera_seed.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace swiftlet::mapping3d {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Standard deviations of a seed in the map: of its position, and of its attitude about each axis.
constexpr double kSigma_m = 0.03, kSigma_rad = 0.0175;
/// An alignment that ends farther from its seed, or is turned by more against it, is rejected.
constexpr double kGate_m = 0.3, kGate_rad = 0.2;
/// Standard deviations of the speed and of the angular rate that a step from seed to seed has.
constexpr double kSpeedSigma_m_s = 0.03, kRateSigma_rad_s = 0.02;
/// Errors of position and attitude that an alignment adds from key frame to key frame, at least.
constexpr double kStepSigma_m = 0.005, kStepSigma_rad = 0.002;
/// Squared error over the expected one of a seed's step beyond which it is an outlier; it has 6 degrees of freedom.
constexpr double kStepGate = 25.0;

Matrix6d diagonal(double sigma_m, double sigma_rad) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(sigma_m * sigma_m);
  covariance.diagonal().tail<3>().setConstant(sigma_rad * sigma_rad);
  return covariance;
}

/// From the axes of the camera to those of the map.
Matrix6d inMapAxes(const Matrix6d& covariance_camera, const Eigen::Quaterniond& R_map_camera) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_map_camera.toRotationMatrix();
  return turn * covariance_camera * turn.transpose();
}

}  // namespace

bool agrees(const common::Pose3& T_map_camera, const CameraSeed& seed) {
  return (T_map_camera.position_m - seed.T_map_camera.position_m).norm() <= kGate_m &&
         T_map_camera.rotation.angularDistance(seed.T_map_camera.rotation) <= kGate_rad;
}

Matrix6d seedCovariance() { return diagonal(kSigma_m, kSigma_rad); }

PosePrior seededPrior(const AlignedFrame& last, const CameraSeed& seed, double gap_s) {
  PosePrior prior;
  prior.T_map_camera = last.T_map_camera * (last.seed.T_map_camera.inverse() * seed.T_map_camera);
  const Matrix6d predicted = last.covariance + diagonal(gap_s * kSpeedSigma_m_s, gap_s * kRateSigma_rad_s);
  prior.information = predicted.inverse();
  if (!seed.is_in_map) return prior;
  const common::Pose3 error = prior.T_map_camera.inverse() * seed.T_map_camera;
  Vector6d innovation;
  innovation << error.position_m, common::logSO3(error.rotation);
  const Matrix6d measured = seedCovariance();
  const Vector6d correction = predicted * (predicted + measured).llt().solve(innovation);
  prior.T_map_camera = prior.T_map_camera * common::Pose3{common::expSO3(correction.tail<3>()), correction.head<3>()};
  prior.information += measured.inverse();
  return prior;
}

PosePrior withSeedStep(const PosePrior& motion, const AlignedFrame& last, const CameraSeed& seed, double gap_s) {
  if (!seed.rate_covariance || gap_s <= 0.0 || motion.information.isZero()) return motion;
  const common::Pose3 step = last.seed.T_map_camera.inverse() * seed.T_map_camera;
  const common::Pose3 measured = last.T_map_camera * step;
  const Matrix6d turned = inMapAxes(*seed.rate_covariance, seed.T_map_camera.rotation.conjugate());
  const Matrix6d measured_covariance = gap_s * gap_s * turned;
  const Matrix6d predicted = motion.information.inverse();
  const common::Pose3 error = motion.T_map_camera.inverse() * measured;
  Vector6d innovation;
  innovation << error.position_m, common::logSO3(error.rotation);
  const Vector6d weighted = (predicted + measured_covariance).llt().solve(innovation);
  if (innovation.dot(weighted) > kStepGate) return motion;
  const Vector6d correction = predicted * weighted;
  return {motion.T_map_camera * common::Pose3{common::expSO3(correction.tail<3>()), correction.head<3>()},
          motion.information + measured_covariance.inverse()};
}

KeyFramePlace placeOfNew(const KeyFramePlace& from, const Alignment& fit, const CameraSeed& seed) {
  const common::Pose3& T_map_camera = fit.T_map_camera;
  const Matrix6d step =
      inMapAxes(fit.measured_information.inverse(), T_map_camera.rotation) + diagonal(kStepSigma_m, kStepSigma_rad);
  const Matrix6d predicted = from.covariance + step;
  Vector6d innovation;
  innovation << seed.T_map_camera.position_m - T_map_camera.position_m,
      common::logSO3(seed.T_map_camera.rotation * T_map_camera.rotation.conjugate());
  const Matrix6d sum = predicted + seedCovariance();
  const Matrix6d gain = sum.llt().solve(predicted).transpose();
  const Vector6d correction = gain * innovation;
  KeyFramePlace place;
  place.scan = seed.scan;
  place.track = from.track;
  place.T_map_key.position_m = T_map_camera.position_m + correction.head<3>();
  place.T_map_key.rotation = common::expSO3(correction.tail<3>()) * T_map_camera.rotation;
  place.T_map_key.rotation.normalize();
  place.covariance = predicted - gain * predicted;
  place.covariance = 0.5 * (place.covariance + place.covariance.transpose()).eval();
  return place;
}

}  // namespace swiftlet::mapping3d
