#include "perception/laser_odometry/laser_front_end.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/scan_matching/scenes.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Pose2;
using common::Time;

/// A robot in a flat; the front end reads its laser.
class Robot {
 public:
  FollowedScan scanAt(const Pose2& truth, double at_s, Duration time_increment = {},
                      const std::optional<Pose2>& T_odom_robot = std::nullopt) {
    common::LaserConfig laser;
    laser.beams = 361;
    laser.sweep_s = 0.0;
    common::RandomStream random(7, "scan", scans_++);
    common::LaserScan scan = test::sweep(
        test::flat(), laser, [&](Time) { return common::lifted(truth, 1.0); }, Time::fromSeconds(at_s), random);
    scan.time_increment = time_increment;
    return front_end_.add({scan, Pose2{}, T_odom_robot}).value();
  }

  const LaserOdometryCounts& counts() const { return front_end_.odometryCounts(); }

 private:
  LaserFrontEnd front_end_{test_support::laserLogFrontEnd()};
  std::uint64_t scans_ = 0;
};

/// The walls beside the robot are always new: no earlier scan has seen them.
TEST(LaserFrontEnd, TracksARobotThatDrivesBackwards) {
  const test::PlanarWorld world = test::corridorWithDoors();
  common::LaserConfig laser;
  laser.beams = 181;
  laser.field_of_view_deg = 180.0;
  laser.sweep_s = 0.0;
  for (const double direction : {1.0, -1.0}) {
    LaserFrontEnd front_end{test_support::laserLogFrontEnd()};
    const double begin_m = direction > 0.0 ? 0.0 : 22.0;
    Pose2 at_end;
    for (int i = 0; i < 360; ++i) {
      common::RandomStream random(7, "scan", static_cast<std::uint64_t>(i));
      const Pose2 truth{begin_m + direction * 0.05 * i, 0.1 * std::sin(0.03 * i), 0.05 * std::sin(0.04 * i)};
      const common::LaserScan scan = test::sweep(
          world, laser, [&](Time) { return common::lifted(truth, 1.0); }, Time::fromSeconds(0.1 * i), random);
      const auto followed = front_end.add({scan, Pose2{}, std::nullopt});
      ASSERT_TRUE(followed);
      at_end = between(Pose2{begin_m, 0.0, 0.0}, truth).inverse() * followed->T_odom_robot;
    }
    EXPECT_LT(at_end.position_m().norm(), 0.3) << direction;
    EXPECT_EQ(front_end.odometryCounts().restarts, 0U) << direction;
  }
}

/// As in the log of MIT's CSAIL: 0.46 m and 87 degrees from one scan to the next, while the robot turns on slowly.
TEST(LaserFrontEnd, IgnoresJumpsOfTheOdometry) {
  Robot robot;
  FollowedScan last;
  Pose2 truth, jump;
  for (int i = 0; i < 60; ++i) {
    truth = {0.02 * i, 0.0, 0.02 * i};
    if (i == 40) jump = {0.46, 0.0, 1.52};
    last = robot.scanAt(truth, 0.1 * i, {}, jump * truth);
    EXPECT_TRUE(i == 0 || last.matched) << i;
  }
  EXPECT_EQ(robot.counts().failures, 0U);
  EXPECT_LT(between(truth, last.T_odom_robot).position_m().norm(), 0.05);
  EXPECT_LT(std::abs(between(truth, last.T_odom_robot).yaw_rad), 0.02);
}

/// During a long pause the robot may have driven on or stood still, so its earlier speed tells nothing.
TEST(LaserFrontEnd, ALongPauseOfALogAddsNoMotion) {
  for (const double pause_s : {5.0, 30.0, 3500.0}) {
    Robot robot;
    Pose2 truth;
    FollowedScan last;
    for (int i = 0; i < 20; ++i) last = robot.scanAt(truth = {0.03 * i, 0.01 * i, 0.02 * i}, 0.1 * i);
    for (int i = 0; i < 20; ++i) last = robot.scanAt(truth, 2.0 + pause_s + 0.1 * i);
    EXPECT_EQ(robot.counts().restarts, 0U) << pause_s;
    EXPECT_LT(between(last.T_odom_robot, truth).position_m().norm(), 0.03) << pause_s;
  }
}

/// A scan is treated as taken at one instant, so the time per beam in the log does not change its stamp.
TEST(LaserFrontEnd, StampsIncreaseWhateverTheTimePerBeam) {
  Robot robot;
  Time last;
  for (int i = 0; i < 30; ++i) {
    const Duration time_increment = Duration::fromSeconds(i == 10 ? 0.5 : 0.0001);
    const FollowedScan followed = robot.scanAt({0.02 * i, 0.0, 0.0}, 0.1 * i, time_increment);
    EXPECT_TRUE(followed.matched) << i;
    EXPECT_TRUE(i == 0 || followed.scan.stamp > last) << i;
    last = followed.scan.stamp;
  }
  EXPECT_EQ(robot.counts().out_of_order, 0U);
}

/// After the robot is carried elsewhere, the odometry restarts with a scan placed at its expected pose. That scan was
/// not matched.
TEST(LaserFrontEnd, AScanThatRestartsTheOdometryIsNotMatched) {
  Robot robot;
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(robot.scanAt({0.02 * i, 0.0, 0.0}, 0.1 * i).matched);
  int breaks = 0;
  for (int i = 0; i < 20; ++i) {
    const FollowedScan followed = robot.scanAt({6.0, 2.0 + 0.02 * i, 2.0}, 2.0 + 0.1 * i);
    breaks += followed.broken ? 1 : 0;
    EXPECT_FALSE(followed.broken && followed.matched) << i;
  }
  EXPECT_EQ(breaks, 1);
}

}  // namespace
}  // namespace swiftlet::perception
