// The covariance of a step of a robot or a vehicle between two scans, if nothing else is known of the step.
#pragma once

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Covariance of the additive errors (x_m, y_m, yaw_rad).
inline Eigen::Matrix3d unknownStepCovariance() {
  // As far as an indoor vehicle moves and turns between two scans of a slow log: 1 m/s and 35 deg/s for half a second.
  constexpr double kSigma_m = 0.5, kSigma_rad = 0.3;
  return common::planarCovariance(kSigma_m, kSigma_rad);
}

/// The covariance itself, or that of an unknown step if it has infinities or NaN.
inline Eigen::Matrix3d stepCovarianceOrUnknown(const Eigen::Matrix3d& covariance) {
  return covariance.allFinite() ? covariance : unknownStepCovariance();
}

}  // namespace swiftlet::perception
