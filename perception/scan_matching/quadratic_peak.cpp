#include "perception/scan_matching/quadratic_peak.hpp"

#include <algorithm>
#include <cmath>

#include "common/small_matrices.hpp"

namespace swiftlet::perception {
namespace {

/// Lower limit on the standard deviation of a pose, whatever the number of points.
constexpr double kFloorSigma_m = 0.0005;
constexpr double kFloorSigma_rad = 0.0001;
/// Standard deviation assigned along an unobservable direction.
constexpr double kUnseenSigma_m = 1.0;
/// Lower limit on the uncertainty of a guess.
constexpr double kLeastSpread_m = 0.001;
constexpr double kLeastSpread_rad = 0.001;

/// The vector in the range of the projection `unseen` that is nearest to `offset`, in units of `spread`.
Eigen::Vector3d mostExpected(const Eigen::Matrix3d& unseen, const Eigen::Vector3d& offset,
                             const Eigen::Vector3d& spread) {
  const Eigen::Matrix3d scaled = spread.cwiseInverse().asDiagonal() * unseen;
  return unseen * common::leastNormSolution(scaled, offset.cwiseQuotient(spread));
}

}  // namespace

ExpectedPose expectedFrom(const common::Pose2& pose, const common::Pose2& guess, const SearchWindow& window) {
  const double spread_m = std::max(window.half_translation_m, kLeastSpread_m);
  return {{guess.x_m - pose.x_m, guess.y_m - pose.y_m, common::wrapAngle(guess.yaw_rad - pose.yaw_rad)},
          {spread_m, spread_m, std::max(window.half_rotation_rad, kLeastSpread_rad)}};
}

Peak findPeak(const Quadratic& q, const PeakScale& scale, const ExpectedPose& expected) {
  const Eigen::Vector3d& step = scale.step;
  const double step2 = step.x() * step.x();
  const double unseen_information = 1.0 / (kUnseenSigma_m * kUnseenSigma_m);

  // In units of one step, so that all three axes move the points by about the same distance.
  const common::SymmetricEigen<3> eigen = common::symmetricEigen(Eigen::Matrix3d(-q.hessian));
  Eigen::Vector3d peak_steps = Eigen::Vector3d::Zero();
  Eigen::Matrix3d unseen = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance_steps = Eigen::Matrix3d::Zero(), peak_of_gradient = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = eigen.vectors.col(i);
    const double curvature = eigen.values(i);
    const double information = std::max(curvature * scale.information_per_curvature, unseen_information);  // 1 / m^2
    covariance_steps += axis * axis.transpose() / (information * step2);
    if (information * scale.unobservable_sigma_m * scale.unobservable_sigma_m > 1.0) {
      const double along = axis.dot(q.gradient) / curvature;
      peak_steps += axis * std::clamp(along, -scale.reach_steps, scale.reach_steps);
      peak_of_gradient += axis * axis.transpose() / curvature;
    } else {
      unseen += axis * axis.transpose();
    }
  }
  peak_steps +=
      mostExpected(unseen, expected.offset.cwiseQuotient(step) - peak_steps, expected.spread.cwiseQuotient(step));

  Peak peak;
  peak.gradient = q.gradient;
  peak.peak_of_gradient = step.asDiagonal() * peak_of_gradient;
  peak.offset = peak_steps.cwiseProduct(step);
  peak.covariance = step.asDiagonal() * covariance_steps * step.asDiagonal();
  peak.covariance.diagonal() +=
      Eigen::Vector3d(kFloorSigma_m * kFloorSigma_m, kFloorSigma_m * kFloorSigma_m, kFloorSigma_rad * kFloorSigma_rad);
  peak.unobservable_motion = leastCertain(peak.covariance, step.x() / step.z(), scale.unobservable_sigma_m);
  return peak;
}

void holdAlong(const common::UnobservableMotion& motion, const ExpectedPose& expected, Peak& peak) {
  const Eigen::Vector3d& change = motion.change;
  peak.offset += change * common::shareAlong(motion).dot(expected.offset - peak.offset);
  const double displaced_m = std::hypot(change.x(), change.y(), motion.lever_m * change.z());
  const Eigen::Vector3d unseen = kUnseenSigma_m / displaced_m * change;
  peak.covariance += unseen * unseen.transpose();
  peak.unobservable_motion = motion;
}

std::optional<common::UnobservableMotion> leastCertain(const Eigen::Matrix3d& covariance, double lever_m,
                                                       double sigma_m) {
  const Eigen::Vector3d displaced(1.0, 1.0, lever_m);
  const common::SymmetricEigen<3> eigen =
      common::symmetricEigen(Eigen::Matrix3d(displaced.asDiagonal() * covariance * displaced.asDiagonal()));
  if (!(eigen.values(2) > sigma_m * sigma_m)) return std::nullopt;
  return common::UnobservableMotion{eigen.vectors.col(2).cwiseQuotient(displaced), lever_m};
}

}  // namespace swiftlet::perception
