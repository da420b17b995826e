// The uncertainty of a position in its least certain direction.
#pragma once

#include <Eigen/Core>

namespace swiftlet::perception {

/// Standard deviation (m), from the covariance of (x_m, y_m, yaw_rad). Infinity if the covariance is not finite.
double greatestSigma_m(const Eigen::Matrix3d& covariance);

}  // namespace swiftlet::perception
