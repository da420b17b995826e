// Motions of SE(2) that a scan does not show.
#include "common/unobservable_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::common {
namespace {

/// The change of a body by a small turn about a point.
UnobservableMotion turnAbout(const Eigen::Vector2d& middle_m, const Eigen::Vector2d& body_m, double lever_m) {
  const Eigen::Vector2d arm_m = body_m - middle_m;
  return {{-arm_m.y(), arm_m.x(), 1.0}, lever_m};
}

TEST(UnobservableMotion, ATurnIsTheSameMotionForABodyElsewhere) {
  const Eigen::Vector2d middle_m(1.0, -2.0), here_m(0.5, 0.3), there_m(-3.0, 1.0);
  const UnobservableMotion moved = movedBy(turnAbout(middle_m, here_m, 2.0), there_m - here_m);
  EXPECT_LT((moved.change - turnAbout(middle_m, there_m, 2.0).change).norm(), 1e-12);
  const UnobservableMotion translation{{0.6, 0.8, 0.0}, 2.0};
  EXPECT_EQ(movedBy(translation, {5.0, 6.0}).change, translation.change);
}

TEST(UnobservableMotion, WhatIsAcrossItIsTheRest) {
  RandomStream random(3, "unobservable motions");
  for (int trial = 0; trial < 100; ++trial) {
    const auto any = [&] { return Eigen::Vector3d(random.gaussian(1.0), random.gaussian(1.0), random.gaussian(1.0)); };
    UnobservableMotion motion{any(), random.uniform(0.1, 10.0)};
    if (trial % 3 == 0) motion.change.z() = 0.0;
    if (trial % 3 == 1) motion.change.head<2>().setZero();
    const auto rows = rowsAcross(motion);
    EXPECT_LT((rows * motion.change).norm(), 1e-12 * motion.change.norm() * (1.0 + motion.lever_m));
    EXPECT_NEAR(shareAlong(motion).dot(motion.change), 1.0, 1e-12);
    const Eigen::Vector2d across_m = any().head<2>();
    EXPECT_LT((rows * changeAcross(motion, across_m) - across_m).norm(), 1e-9);
    // Every change is its part along the motion and its part across.
    const Eigen::Vector3d change = any();
    const Eigen::Vector3d sum = shareAlong(motion).dot(change) * motion.change + changeAcross(motion, rows * change);
    EXPECT_LT((sum - change).norm(), 1e-9 * (1.0 + change.norm()));
    const Eigen::Matrix3d across = withoutVarianceAlong(motion, motion.change * motion.change.transpose());
    EXPECT_LT(across.norm(), 1e-9 * motion.change.squaredNorm() * (1.0 + motion.lever_m * motion.lever_m));
    EXPECT_NEAR(likeness(motion, {-2.0 * motion.change, motion.lever_m}), 1.0, 1e-12);
  }
}

TEST(UnobservableMotion, AZeroOneIsNotValid) {
  EXPECT_TRUE(isValid(UnobservableMotion{}));
  EXPECT_FALSE(isValid(UnobservableMotion{Eigen::Vector3d::Zero(), 1.0}));
  EXPECT_FALSE(isValid(UnobservableMotion{Eigen::Vector3d::UnitZ(), 0.0}));
  EXPECT_FALSE(isValid(UnobservableMotion{{std::nan(""), 0.0, 1.0}, 1.0}));
}

}  // namespace
}  // namespace swiftlet::common
