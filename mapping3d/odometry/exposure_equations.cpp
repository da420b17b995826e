#include "mapping3d/odometry/exposure_equations.hpp"

#include <Eigen/Cholesky>

namespace swiftlet::mapping3d {
namespace {

/// Weak priors keep the equations solvable without texture or without surfaces: a gain near 1 (0.3), an offset near 0
/// (50 grey levels), a step of 1 m or 1 rad.
constexpr double kGainInformation = 1.0 / (0.3 * 0.3);
constexpr double kOffsetInformation = 1.0 / (50.0 * 50.0);
constexpr double kStepInformation = 1.0;

}  // namespace

ExposureEquations::Matrix8d ExposureEquations::damped() const {
  Matrix8d matrix = matrix_.selfadjointView<Eigen::Lower>();
  for (int i = 0; i < 6; ++i) matrix(i, i) += kStepInformation;
  matrix(6, 6) += kGainInformation;
  matrix(7, 7) += kOffsetInformation;
  return matrix;
}

ExposureEquations::Vector8d ExposureEquations::solve() const { return damped().ldlt().solve(right_); }

Eigen::Matrix<double, 6, 6> ExposureEquations::poseInformation() const {
  const Matrix8d matrix = damped();
  const Eigen::Matrix<double, 6, 2> mixed = matrix.topRightCorner<6, 2>();
  const Eigen::Matrix2d exposure = matrix.bottomRightCorner<2, 2>();
  return matrix.topLeftCorner<6, 6>() - mixed * exposure.llt().solve(mixed.transpose());
}

}  // namespace swiftlet::mapping3d
