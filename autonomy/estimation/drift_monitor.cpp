#include "autonomy/estimation/drift_monitor.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace swiftlet::autonomy {

double DriftMonitor::add(const Eigen::Matrix2d& covariance_m2, bool fixed) {
  if (fixed) fixed_covariance_m2_ = covariance_m2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> grown(covariance_m2 - fixed_covariance_m2_,
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, grown.eigenvalues().maxCoeff()));
}

}  // namespace swiftlet::autonomy
