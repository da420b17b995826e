#include "perception/visual_odometry/gaussian_registration.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace swiftlet::perception {
namespace {

using common::Pose3;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kIterations = 8;
/// Squared Mahalanobis distance that 1 % of the right pairs exceed (chi-squared, 3 degrees of freedom).
constexpr double kGate = 11.34;

/// What all pairs together say of the error (position, rotation vector) at T_from_to.
struct Equations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi2 = 0.0;
  int pairs = 0;
};

/// from = T (to + position + rotation x to), so the residual from - T to changes by R position - R [to]x rotation.
Equations equationsAt(const Pose3& T_from_to, const std::vector<PointPair>& pairs) {
  const Eigen::Matrix3d R = T_from_to.rotation.toRotationMatrix();
  Equations sums;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d& to = pair.to.mean_camera_m;
    const Eigen::Vector3d residual = pair.from.mean_camera_m - T_from_to * to;
    const Eigen::Matrix3d covariance =
        pair.from.covariance_camera_m2 + R * pair.to.covariance_camera_m2 * R.transpose();
    const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
    if (factor.info() != Eigen::Success) continue;
    const double distance2 = residual.dot(factor.solve(residual));
    if (!(distance2 <= kGate)) continue;
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << R, -R * common::skew(to);
    const Eigen::Matrix<double, 3, 6> weighted = factor.solve(jacobian);
    sums.information += jacobian.transpose() * weighted;
    sums.gradient += weighted.transpose() * residual;
    sums.chi2 += distance2;
    ++sums.pairs;
  }
  return sums;
}

}  // namespace

std::optional<GaussianRegistration> refined(const std::vector<PointPair>& pairs, const Pose3& T_from_to,
                                            int least_pairs) {
  GaussianRegistration result;
  result.T_from_to = T_from_to;
  for (int i = 0; i < kIterations; ++i) {
    const Equations sums = equationsAt(result.T_from_to, pairs);
    if (sums.pairs < least_pairs) return std::nullopt;
    const Eigen::LLT<Matrix6d> factor(sums.information);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Vector6d step = factor.solve(sums.gradient);
    if (!step.allFinite()) return std::nullopt;
    result.pairs = sums.pairs;
    result.chi2_per_dof = sums.chi2 / (3.0 * sums.pairs - 6.0);
    result.covariance = factor.solve(Matrix6d::Identity());
    result.T_from_to = result.T_from_to * Pose3{common::expSO3(step.tail<3>()), step.head<3>()};
    if (step.norm() < 1e-6) break;
  }
  // The points may be better or worse than they say; how far they are apart tells.
  constexpr double kLeastScale = 0.1;
  result.covariance *= std::max(kLeastScale, result.chi2_per_dof);
  result.covariance = 0.5 * (result.covariance + result.covariance.transpose()).eval();
  return result;
}

}  // namespace swiftlet::perception
