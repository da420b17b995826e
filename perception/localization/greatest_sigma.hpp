// How uncertain a position is in the direction that is known least.
#pragma once

#include <Eigen/Core>

namespace swiftlet::perception {

/// Standard deviation (m), from the covariance of (x_m, y_m, yaw_rad). Infinity where the covariance is none.
double greatestSigma_m(const Eigen::Matrix3d& covariance);

}  // namespace swiftlet::perception
