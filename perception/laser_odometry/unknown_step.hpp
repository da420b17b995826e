// The uncertainty of a step of which nothing is known but that it was one of a robot or a vehicle between two scans.
#pragma once

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Of the additive errors (x_m, y_m, yaw_rad).
inline Eigen::Matrix3d unknownStepCovariance() {
  constexpr double kSigma_m = 0.5, kSigma_rad = 0.3;
  return common::planarCovariance(kSigma_m, kSigma_rad);
}

/// A covariance that is none, with infinities or NaN, says nothing.
inline Eigen::Matrix3d stepCovarianceOrUnknown(const Eigen::Matrix3d& covariance) {
  return covariance.allFinite() ? covariance : unknownStepCovariance();
}

}  // namespace swiftlet::perception
