#include "mapping3d/odometry/measured_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace swiftlet::mapping3d {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Standard deviation along a direction that was not seen: as good as none against any state in flight.
constexpr double kUnseenSigma_m = 100.0;

/// A direction of whose information more than this share may be the noise of grey values counts as not seen.
constexpr double kMostNoise = 0.5;
/// Least standard deviations of a measured position, and of a measured attitude about each axis.
constexpr double kFloor_m = 0.004, kFloor_rad = 0.002;

/// The information without what noise gives. In directions of which more than kMostNoise is noise there is none.
Matrix6d withoutNoise(const Matrix6d& information, const Matrix6d& noise) {
  // Both are diagonal in the same coordinates, in which all of the information is 1.
  const Matrix6d root = information.llt().matrixL();
  const Matrix6d half = root.triangularView<Eigen::Lower>().solve(noise);
  const Matrix6d share = root.triangularView<Eigen::Lower>().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(0.5 * (share + share.transpose()));
  const Vector6d left = solver.eigenvalues().unaryExpr([](double s) { return s > kMostNoise ? 0.0 : 1.0 - s; });
  const Matrix6d axes = root * solver.eigenvectors();
  return axes * left.asDiagonal() * axes.transpose();
}

}  // namespace

MeasuredPose withoutPrior(const Alignment& fit, double gradient_variance, const PosePrior& prior, double depth_m,
                          double least_share, double sigma_factor) {
  // In these units the six unknowns move points equally far.
  Vector6d unit;
  unit << 1.0, 1.0, 1.0, Eigen::Vector3d::Constant(1.0 / depth_m);
  const Matrix6d noise = gradient_variance * fit.gradient_noise;
  const Matrix6d information = unit.asDiagonal() * withoutNoise(fit.measured_information, noise) * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information);
  const common::Pose3 error = prior.T_map_camera.inverse() * fit.T_map_camera;
  Vector6d from_prior;
  from_prior << error.position_m, common::logSO3(error.rotation);
  const Vector6d pulled = unit.asDiagonal() * (prior.information * from_prior);

  const double least = least_share * solver.eigenvalues()[5];
  Vector6d shift = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector6d direction = solver.eigenvectors().col(i);
    const double seen = solver.eigenvalues()[i];
    if (seen <= least) {
      covariance += kUnseenSigma_m * kUnseenSigma_m * direction * direction.transpose();
      continue;
    }
    shift += direction * (direction.dot(pulled) / seen);
    covariance += sigma_factor * sigma_factor / seen * direction * direction.transpose();
  }
  shift = unit.asDiagonal() * shift;
  MeasuredPose measured;
  measured.T_map_camera = fit.T_map_camera * common::Pose3{common::expSO3(shift.tail<3>()), shift.head<3>()};
  measured.covariance = unit.asDiagonal() * covariance * unit.asDiagonal();
  measured.covariance.diagonal().head<3>().array() += kFloor_m * kFloor_m;
  measured.covariance.diagonal().tail<3>().array() += kFloor_rad * kFloor_rad;
  measured.covariance = 0.5 * (measured.covariance + measured.covariance.transpose()).eval();
  return measured;
}

}  // namespace swiftlet::mapping3d
