// How uncertain the motion between two scans is along a wall that does not fix it.
#include "autonomy/estimation/step_uncertainty.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Pose2;

class StepUncertaintyTest : public testing::Test {
 protected:
  /// A scan with the filter's variance along x of odom after it. The body is turned by `yaw_rad`; the clone that the
  /// measurement starts from has the axes of odom.
  Eigen::Matrix3d scan(double variance_x_m2, bool sees_x, double yaw_rad = 0.0) {
    OdometryStep step;
    step.matched = true;
    step.covariance = 1e-4 * Eigen::Matrix3d::Identity();
    step.measurement.emplace();
    step.measurement->pose = {1.0, 2.0, yaw_rad};
    if (!sees_x) step.measurement->unobservable_motion.emplace();
    Eigen::Matrix3d covariance = 0.5 * Eigen::Matrix3d::Identity();
    covariance(0, 0) = variance_x_m2;
    return uncertainty_.add(step, Pose2{3.0, 4.0, yaw_rad}, covariance);
  }

  StepUncertainty uncertainty_;
};

TEST_F(StepUncertaintyTest, WhereEveryDirectionIsSeenItIsThatOfTheMatch) {
  (void)scan(0.01, true);
  EXPECT_TRUE(scan(0.81, true).isApprox(1e-4 * Eigen::Matrix3d::Identity()));
}

TEST_F(StepUncertaintyTest, AlongAWallItGrowsAsTheFilterSays) {
  (void)scan(0.01, true);
  const Eigen::Matrix3d step = scan(0.10, false);
  EXPECT_NEAR(step(0, 0), 0.09, 1e-3);
  EXPECT_NEAR(step(1, 1), 1e-4, 1e-12) << "across the wall";
  EXPECT_NEAR(step(2, 2), 1e-4, 1e-12);
}

TEST_F(StepUncertaintyTest, ItHasTheAxesOfTheBody) {
  (void)scan(0.01, true);
  const Eigen::Matrix3d step = scan(0.10, false, std::numbers::pi / 2.0);
  EXPECT_NEAR(step(0, 0), 1e-4, 1e-9);
  EXPECT_NEAR(step(1, 1), 0.09, 1e-3) << "the wall lies to the side of the body";
}

/// What corrects the position moves it, by as much as it was uncertain.
TEST_F(StepUncertaintyTest, ThePoseThatIsFixedAgainIsUncertainAgainstThoseBefore) {
  (void)scan(0.01, true);
  (void)scan(1.01, false);
  EXPECT_NEAR(scan(0.02, true)(0, 0), 0.99, 1e-3);
  EXPECT_NEAR(scan(0.02, true)(0, 0), 1e-4, 1e-12) << "after that nothing is corrected";
}

}  // namespace
}  // namespace swiftlet::autonomy
