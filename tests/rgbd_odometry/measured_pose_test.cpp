// A prior leaves the measurement that a filter gets as it would be without it.
#include "mapping3d/odometry/measured_pose.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Pose3 moved(const Pose3& pose, const Vector6d& error) {
  return pose * Pose3{common::expSO3(error.tail<3>()), error.head<3>()};
}

/// An alignment whose frame alone says `measured`, with a prior at the identity.
Alignment combined(const Vector6d& measured, const Matrix6d& seen, const Matrix6d& prior) {
  Alignment fit;
  fit.T_map_camera = moved({}, (seen + prior).inverse() * (seen * measured));
  fit.measured_information = seen;
  fit.information = seen + prior;
  return fit;
}

Matrix6d information(const Vector6d& sigmas) { return sigmas.cwiseInverse().cwiseAbs2().asDiagonal(); }

TEST(MeasuredPose, ThePriorIsTakenOut) {
  Vector6d measured, sigmas;
  measured << 0.02, -0.01, 0.015, 0.004, -0.003, 0.002;
  sigmas << 0.004, 0.006, 0.005, 0.002, 0.003, 0.002;
  const Matrix6d seen = information(sigmas);
  const PosePrior prior{{}, 3.0 * seen};
  const Alignment fit = combined(measured, seen, prior.information);
  ASSERT_LT(fit.T_map_camera.position_m.norm(), 0.3 * measured.head<3>().norm()) << "the prior pulls";
  const MeasuredPose pose = withoutPrior(fit, 0.0, prior, 2.0);
  EXPECT_LT((pose.T_map_camera.position_m - moved({}, measured).position_m).norm(), 2e-4);
  EXPECT_LT(pose.T_map_camera.rotation.angularDistance(moved({}, measured).rotation), 1e-4);
  EXPECT_NEAR(pose.covariance(1, 1), 0.006 * 0.006 + 0.004 * 0.004, 1e-7);
}

TEST(MeasuredPose, AlongABareWallNothingIsMeasured) {
  Vector6d sigmas;
  sigmas << 0.002, 0.05, 0.002, 0.002, 0.002, 0.002;
  const Matrix6d seen = information(sigmas);
  const PosePrior prior{{}, information(Vector6d::Constant(0.01))};
  const MeasuredPose pose = withoutPrior(combined(Vector6d::Constant(0.001), seen, prior.information), 0.0, prior, 1.0);
  EXPECT_GT(pose.covariance(1, 1), 100.0);
  EXPECT_LT(pose.covariance(0, 0), 1e-4);
  EXPECT_LT(pose.T_map_camera.position_m.y(), 0.001) << "an unseen direction is not extrapolated";
}

}  // namespace
}  // namespace swiftlet::mapping3d
