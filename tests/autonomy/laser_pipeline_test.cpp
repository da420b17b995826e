// The measurements of the motion by the laser, scan by scan, as values for the filter.
#include "autonomy/estimation/laser_pipeline.hpp"

#include <gtest/gtest.h>

#include "tests/autonomy/estimator_story.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose2;

struct LaserStory : testing::Test {
  OdometryStep see(const test::PlanarWorld& world, const Pose2& truth) {
    return laser.match(test::scanAt(world, truth, ++frame), filter);
  }

  LaserPipeline laser{LaserPipelineConfig{}, common::LaserConfig{}};
  FilterView filter;
  std::uint64_t frame = 0;
  const test::PlanarWorld flat = test::flat();
};

TEST_F(LaserStory, TheFirstScanIsClonedAndGivesNoMeasurement) {
  const OdometryStep first = see(flat, {0, 0, 0});
  EXPECT_TRUE(first.matched);
  EXPECT_FALSE(first.interrupted);
  EXPECT_FALSE(first.measurement);
  ASSERT_TRUE(first.clone_after);
  EXPECT_EQ(*first.clone_after, laser.clone());
  EXPECT_TRUE(first.covariance.isZero()) << "nothing has drifted yet";
}

TEST_F(LaserStory, LaterScansAreMeasuredFromTheClone) {
  const common::Time clone = *see(flat, {0, 0, 0}).clone_after;
  filter.has_clone = true;
  for (int i = 1; i <= 5; ++i) {
    const OdometryStep step = see(flat, {0.02 * i, 0.01 * i, 0.002 * i});
    ASSERT_TRUE(step.matched && step.measurement);
    EXPECT_FALSE(step.clone_before);
    EXPECT_EQ(step.measurement->from, clone);
    EXPECT_NEAR(step.measurement->pose.x_m, 0.02 * i, 0.01);
    EXPECT_NEAR(step.measurement->pose.y_m, 0.01 * i, 0.01);
    EXPECT_GE(std::sqrt(step.measurement->covariance(0, 0)), LaserPipeline::kMatchFloor_m);
    EXPECT_TRUE(step.covariance.isZero()) << "within one reference nothing drifts";
  }
}

TEST_F(LaserStory, ANewReferenceAddsDriftAndIsStillMeasuredFromTheClone) {
  const common::Time clone = *see(flat, {0, 0, 0}).clone_after;
  filter.has_clone = true;
  bool drifted = false;
  for (int i = 1; i <= 60 && !drifted; ++i) {
    const OdometryStep step = see(flat, {0.035 * i, 0, 0});
    ASSERT_TRUE(step.measurement) << i;
    EXPECT_EQ(step.measurement->from, clone) << "references are not cloned one after the other";
    drifted = !step.covariance.isZero();
    EXPECT_TRUE(!drifted || std::sqrt(step.covariance(0, 0)) >= LaserPipeline::kDriftFloor_m);
  }
  EXPECT_TRUE(drifted);
}

TEST_F(LaserStory, ClonesTheReferenceWhenTheFilterDroppedTheClone) {
  const common::Time reference = *see(flat, {0, 0, 0}).clone_after;
  filter.has_clone = false;
  const OdometryStep step = see(flat, {0.02, 0, 0});
  ASSERT_TRUE(step.clone_before && step.measurement);
  EXPECT_EQ(*step.clone_before, reference);
  EXPECT_EQ(step.measurement->from, reference);
}

/// Directions that differ from scan to scan would tell the filter the position along the corridor.
TEST_F(LaserStory, ACorridorKeepsItsUnseenDirection) {
  const test::PlanarWorld corridor = test::corridor();
  filter.has_clone = true;
  double axis_odom_rad = 0.0, clone_yaw_rad = 0.0;  // Of the walls and of the last clone, as far as it was measured.
  int unseen = 0, clones = 0;
  for (int i = 0; i < 80; ++i) {
    const OdometryStep step = see(corridor, {0.03 * i, 0.0, 0.004 * i});
    ASSERT_TRUE(step.matched) << i;
    if (step.measurement && step.measurement->unobservable_motion) {
      const Eigen::Vector3d& along = step.measurement->unobservable_motion->change;
      EXPECT_EQ(along.z(), 0.0) << i;
      const double now_rad = std::atan2(along.y(), along.x()) + clone_yaw_rad;
      if (unseen++ > 0) {
        EXPECT_NEAR(std::sin(now_rad - axis_odom_rad), 0.0, 1e-9) << i;
      }
      axis_odom_rad = now_rad;
    }
    if (!step.clone_after) continue;
    if (step.measurement) clone_yaw_rad += step.measurement->pose.yaw_rad;
    ++clones;
  }
  EXPECT_GT(unseen, 60);
  EXPECT_GT(clones, 1) << "the direction must be carried to another clone";
}

/// The middle of a round room stands still: the turn about it is the same motion wherever the vehicle is.
TEST_F(LaserStory, ARoundRoomKeepsItsMiddle) {
  const test::PlanarWorld room = test::roundRoom(4.0);
  filter.has_clone = true;
  int unseen = 0;
  for (int i = 0; i < 60; ++i) {
    const OdometryStep step = see(room, {0.03 * i - 0.5, 0.3, 0.004 * i});
    ASSERT_TRUE(step.matched) << i;
    if (!step.measurement || !step.measurement->unobservable_motion) continue;
    const common::UnobservableMotion& motion = *step.measurement->unobservable_motion;
    const Eigen::Vector2d turned_m(motion.change.x(), motion.change.y());
    // From the body to the point that the turn leaves where it is.
    const Eigen::Vector2d to_middle_m = Eigen::Vector2d(-turned_m.y(), turned_m.x()) / motion.change.z();
    EXPECT_NEAR(to_middle_m.norm(), Eigen::Vector2d(0.03 * i - 0.5, 0.3).norm(), 0.15) << i;
    ++unseen;
  }
  EXPECT_GT(unseen, 50);
}

/// The covariance is given at the reference scan, the direction along the corridor at the new one; between the two the
/// vehicle has turned.
TEST_F(LaserStory, NothingIsAddedToTheDriftAlongACorridor) {
  const test::PlanarWorld corridor = test::corridor();
  const double floor_m2 = LaserPipeline::kDriftFloor_m * LaserPipeline::kDriftFloor_m;
  filter.has_clone = true;
  int references = 0;
  for (int i = 0; i < 80; ++i) {
    const double yaw_rad = 0.02 * i;
    const OdometryStep step = see(corridor, {0.0, 0.0, yaw_rad});
    ASSERT_TRUE(step.matched) << i;
    if (!step.measurement || step.covariance.isZero()) continue;
    ASSERT_TRUE(step.measurement->unobservable_motion) << i;
    ++references;
    const Eigen::Vector2d along_body(std::cos(yaw_rad), -std::sin(yaw_rad));
    EXPECT_LT(along_body.dot(step.covariance.topLeftCorner<2, 2>() * along_body), 1.1 * floor_m2) << i;
  }
  EXPECT_GT(references, 1);
}

TEST_F(LaserStory, AnInterruptionHasTheUncertaintyOfTheWidestWindow) {
  const LaserPipelineConfig config;
  (void)see(flat, {0, 0, 0});
  filter.has_clone = true;
  const test::PlanarWorld elsewhere = den({0.0, 0.0}, 1.2);
  OdometryStep step;
  int failures = 0;
  while (failures < 100 && !(step = see(elsewhere, {0, 0, 0})).matched) {
    ++failures;
    EXPECT_TRUE(step.covariance.isZero());
    EXPECT_FALSE(step.measurement || step.clone_after || step.interrupted);
  }
  EXPECT_EQ(failures, config.odometry.max_failures - 1);
  EXPECT_TRUE(step.interrupted);
  EXPECT_TRUE(step.clone_after);
  EXPECT_FALSE(step.measurement) << "how it came here is not known";
  EXPECT_DOUBLE_EQ(std::sqrt(step.covariance(0, 0)), config.odometry.max_window_m);
  EXPECT_DOUBLE_EQ(std::sqrt(step.covariance(2, 2)), config.odometry.max_window_deg * common::kRadPerDeg);
}

/// The attitude that projects a tilted scan has an error, so the match of such a scan is less certain.
TEST_F(LaserStory, TiltIncreasesTheCovarianceOfTheMatch) {
  (void)see(flat, {0, 0, 0});
  filter.has_clone = true;
  const OdometryStep level = see(flat, {0.01, 0, 0});
  perception::ProjectedScan scan = test::scanAt(flat, {0.02, 0, 0}, ++frame);
  scan.T_odom_body.rotation = common::quaternionFrom({0.2, 0.0, 0.0});
  const OdometryStep tilted = laser.match(scan, filter);
  ASSERT_TRUE(level.measurement && tilted.measurement);
  EXPECT_GT(tilted.measurement->covariance(0, 0), level.measurement->covariance(0, 0) + 0.005 * 0.005);
}

}  // namespace
}  // namespace swiftlet::autonomy
