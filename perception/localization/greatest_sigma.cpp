#include "perception/localization/greatest_sigma.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/small_matrices.hpp"

namespace swiftlet::perception {

double greatestSigma_m(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d variances_m2 = common::symmetricEigenvalues(Eigen::Matrix2d(covariance.topLeftCorner<2, 2>()));
  return std::sqrt(std::max(0.0, variances_m2(1)));
}

}  // namespace swiftlet::perception
