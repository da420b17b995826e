#include "perception/laser_odometry/motion_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

using common::Pose2;

constexpr double kDt_s = 0.2;

Eigen::Matrix3d matchCovariance() { return Eigen::Vector3d(1e-6, 1e-6, 1e-7).asDiagonal(); }

/// One step of a robot that is matched at `truth`, relative to where it began.
void step(MotionPrediction& motion, const Pose2& truth, const std::optional<Pose2>& odom) {
  motion.predict(odom, kDt_s);
  motion.correct(truth, matchCovariance(), std::nullopt);
}

TEST(MotionPrediction, TheFirstStepFollowsTheWheels) {
  MotionPrediction motion({});
  motion.begin(Pose2{5.0, 2.0, 0.5});
  motion.predict(Pose2{5.0, 2.0, 0.5} * Pose2{0.3, 0.0, 0.1}, kDt_s);
  EXPECT_NEAR(motion.T_reference_robot().x_m, 0.3, 1e-9);
  EXPECT_NEAR(motion.T_reference_robot().yaw_rad, 0.1, 1e-9);
}

TEST(MotionPrediction, KeepsTheLastSpeedWithoutWheels) {
  MotionPrediction motion({});
  motion.begin(std::nullopt);
  Pose2 truth;
  for (int i = 0; i < 40; ++i) step(motion, truth = truth * Pose2{0.1, 0.0, 0.02}, std::nullopt);
  motion.predict(std::nullopt, kDt_s);
  const Pose2 error = between(truth * Pose2{0.1, 0.0, 0.02}, motion.T_reference_robot());
  EXPECT_LT(error.position_m().norm(), 0.002);
  EXPECT_LT(std::abs(error.yaw_rad), 0.001);
}

/// Wheels that lag by two scans predict a winding path worse than constant velocity does, and are not followed.
TEST(MotionPrediction, FollowsTheBetterSource) {
  for (const int lag : {0, 2}) {
    MotionPrediction motion({});
    motion.begin(Pose2{});
    std::vector<Pose2> truth{Pose2{}};
    for (int i = 1; i < 200; ++i) truth.push_back(truth.back() * Pose2{0.1, 0.0, 0.08 * std::sin(0.12 * i)});
    double worst_rad = 0.0;
    for (int i = 1; i < 200; ++i) {
      const auto at = static_cast<std::size_t>(i);
      motion.predict(truth[static_cast<std::size_t>(std::max(0, i - lag))], kDt_s);
      const Pose2 error = between(truth[at], motion.T_reference_robot());
      if (i > 100) worst_rad = std::max(worst_rad, std::abs(error.yaw_rad));
      motion.correct(truth[at], matchCovariance(), std::nullopt);
    }
    EXPECT_LT(worst_rad, lag == 0 ? 0.002 : 0.012) << lag;  // The wheels that lag are off by 0.019.
  }
}

TEST(MotionPrediction, IgnoresAJumpOfTheWheels) {
  MotionPrediction motion({});
  motion.begin(Pose2{});
  Pose2 truth;
  for (int i = 0; i < 40; ++i) step(motion, truth = truth * Pose2{0.1, 0.0, 0.0}, truth * Pose2{0.1, 0.0, 0.0});
  motion.predict(truth * Pose2{30.0, 0.0, 0.0}, kDt_s);
  EXPECT_EQ(motion.implausibleSteps(), 1U);
  EXPECT_LT(between(truth, motion.T_reference_robot()).position_m().norm(), 0.2);
}

TEST(MotionPrediction, TheAlternativeReplacesThePrediction) {
  MotionPrediction motion({}), never_wrong({});
  for (MotionPrediction* one : {&motion, &never_wrong}) one->begin(Pose2{});
  Pose2 truth;
  for (int i = 0; i < 60; ++i) {
    truth = truth * Pose2{0.05, 0.0, 0.01};
    for (MotionPrediction* one : {&motion, &never_wrong}) step(*one, truth, truth);
  }
  truth = truth * Pose2{0.05, 0.0, 0.01};
  motion.predict(truth * Pose2{0.0, 0.4, 1.5}, kDt_s);  // The wheels slip on the spot.
  EXPECT_GT(std::abs(between(truth, motion.T_reference_robot()).yaw_rad), 1.4);
  ASSERT_TRUE(motion.alternative());
  motion.takeAlternative();
  EXPECT_LT(std::abs(between(truth, motion.T_reference_robot()).yaw_rad), 0.02);
  EXPECT_LT(between(truth, motion.T_reference_robot()).position_m().norm(), 0.02);
  // The rejected step is neither in the uncertainty nor in the speed.
  never_wrong.predict(std::nullopt, kDt_s);
  EXPECT_TRUE(motion.covariance().isApprox(never_wrong.covariance()));
}

TEST(MotionPrediction, HasNoAlternativeWithoutWheels) {
  MotionPrediction motion({});
  motion.begin(std::nullopt);
  motion.predict(std::nullopt, kDt_s);
  EXPECT_FALSE(motion.alternative());
}

TEST(MotionPrediction, ThePoseAfterALossIsUncertainUnlessThereAreWheels) {
  const auto sigmaAfterLoss_m = [](bool wheels) {
    MotionPrediction motion({});
    motion.begin(wheels ? std::optional(Pose2{}) : std::nullopt);
    Pose2 truth;
    const auto odom = [&] { return wheels ? std::optional(truth) : std::nullopt; };
    for (int i = 0; i < 60; ++i) {
      truth = truth * Pose2{0.1, 0.0, 0.0};
      step(motion, truth, odom());
    }
    for (int i = 0; i < 4; ++i) {
      truth = truth * Pose2{0.1, 0.0, 0.0};
      motion.predict(odom(), kDt_s);
      motion.lose(1.0, 1.0);
    }
    return std::sqrt(motion.covariance()(0, 0));
  };
  EXPECT_GT(sigmaAfterLoss_m(false), 1.9);
  EXPECT_LT(sigmaAfterLoss_m(true), 0.1);
}

}  // namespace
}  // namespace swiftlet::perception
