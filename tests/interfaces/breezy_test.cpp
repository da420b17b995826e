// BreezySLAM's .dat: the rover's odometry and its short-range laser.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "interfaces/laser_log/breezy.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "tests/interfaces/support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::ProblemIs;

constexpr double kPi = std::numbers::pi;

std::string line(double time_us, int left, int right, const std::string& ranges) {
  std::string text =
      std::to_string(static_cast<long long>(time_us)) + " 14710 " + std::to_string(left) + " " + std::to_string(right);
  for (int i = 0; i < 20; ++i) text += i == 3 ? " 170.1" : " 0";
  return text + "  " + ranges + " \n";
}

TEST(Breezy, ARecordGivesAScanAndAWheelOdometryPose) {
  const ScratchFolder folder;
  // A turn of both wheels, then a turn on the spot by a quarter.
  const int quarter = static_cast<int>(std::lround(0.25 * kPi * 2.0 * 0.165 / (2.0 * kPi * 0.077) * 2000.0));
  put(folder / "a", line(2e6, 1000, 1000, "0 6 1500 5600 250") + line(2.1e6, 3000, 3000, "1000 1000 1000 1000 1000") +
                        line(2.2e6, 3000 - quarter, 3000 + quarter, "1000 1000 1000 1000 1000"));
  const auto log = openLaserLog(folder / "a");
  const auto first = log->next(), second = log->next(), third = log->next();
  ASSERT_TRUE(first && second && third);
  EXPECT_EQ(log->format(), "BreezySLAM .dat");
  EXPECT_DOUBLE_EQ(first->scan.stamps.measured.seconds(), 2.0);
  EXPECT_NEAR(first->scan.angle_increment_rad, 2.0 * kPi / 1024.0, 1e-12);
  EXPECT_NEAR(first->scan.angle_min_rad, -2.0 * first->scan.angle_increment_rad, 1e-12)
      << "straight ahead is the middle";
  EXPECT_FLOAT_EQ(first->scan.ranges_m[2], 1.5F);
  EXPECT_LT(first->scan.ranges_m[1], first->scan.range_min_m) << "an error code is no range";
  EXPECT_TRUE(std::isinf(first->scan.ranges_m[3]));
  EXPECT_DOUBLE_EQ(first->T_robot_laser.x_m, 0.145);
  EXPECT_DOUBLE_EQ(first->T_odom_robot->x_m, 0.0);
  EXPECT_NEAR(second->T_odom_robot->x_m, 2.0 * kPi * 0.077, 1e-9);
  EXPECT_NEAR(third->T_odom_robot->yaw_rad, 0.5 * kPi, 1e-3);
  EXPECT_NEAR(third->T_odom_robot->x_m, 2.0 * kPi * 0.077, 1e-9);
}

TEST(Breezy, SkipsBadRecordsAndReportsTheirPlace) {
  const ScratchFolder folder;
  const std::string good = line(1e6, 0, 0, "1000 1000");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "1000 ";
  put(folder / "a", good + "\n" + good.substr(0, 30) + "\n" + line(1e6, 0, 0, "1000 x") + line(1e6, 0, 0, "") +
                        line(1e6, 0, 0, many) + "1e300" + good + "\x80\xff\n" + good);
  const auto log = openLaserLog(folder / "a");
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_EQ(scans, 2);
  EXPECT_EQ(log->counts().skipped_records, 6U);
  EXPECT_EQ(log->counts().first_problems.at(1).location.line, 4);
  EXPECT_THAT(log->counts().first_problems.at(1), ProblemIs("text.not-a-number", "range"));
  EXPECT_THAT(log->counts().first_problems.at(3), ProblemIs("laser-log.wider-than-laser"));
}

TEST(Breezy, SkipsLinesWithAnUnusualNumberOfRanges) {
  const ScratchFolder folder;
  const std::string whole = line(1e6, 0, 0, "1000 1000 1000 1000"), half = line(1e6, 0, 0, "1000 1000");
  for (const std::string& text : {half + whole + whole, whole + half + whole, whole + half}) {
    put(folder / "a", text);
    const auto log = openLaserLog(folder / "a");
    while (const auto logged = log->next()) EXPECT_EQ(logged->scan.ranges_m.size(), 4U);
    EXPECT_EQ(log->counts().skipped_records, 1U) << text;
    EXPECT_THAT(log->counts().first_problems.at(0), ProblemIs("laser-log.other-beams", "range"));
  }
}

TEST(Breezy, StampsHaveTheSameBoundsAsInOtherFormats) {
  const ScratchFolder folder;
  put(folder / "a", line(4.5e15, 0, 0, "1000 1000") + line(5e15, 0, 0, "1000 1000") + line(-5e15, 0, 0, "1000 1000"));
  const auto log = openLaserLog(folder / "a");
  EXPECT_EQ(log->next()->scan.stamps.measured, common::Time::fromSeconds(4.5e9));
  EXPECT_FALSE(log->next());
  EXPECT_EQ(log->counts().skipped_records, 2U);
}

TEST(Breezy, ReadsACompressedRecordedLog) {
  const auto file = test_support::dataSet("01-laser-slam/mines-exp1/exp1.dat.gz");
  if (!file) return;
  const auto log = openLaserLog(*file);
  auto logged = log->next();
  ASSERT_TRUE(logged);
  EXPECT_EQ(logged->scan.stamps.measured.nanoseconds(), 212'387282000);
  common::Pose2 T_odom_robot = *logged->T_odom_robot;
  double path_m = 0.0;
  common::Time last;
  do {
    EXPECT_EQ(logged->scan.ranges_m.size(), 683U);
    path_m += (logged->T_odom_robot->position_m() - T_odom_robot.position_m()).norm();
    T_odom_robot = *logged->T_odom_robot;
    last = logged->scan.stamps.measured;
  } while ((logged = log->next()));
  EXPECT_EQ(log->counts().scans, 756U);
  EXPECT_EQ(log->counts().skipped_records, 0U);
  EXPECT_EQ(log->counts().invalid_ranges, 0U);
  EXPECT_EQ(last.nanoseconds(), 287'007421000);
  EXPECT_NEAR(path_m, 45.97, 0.05);
  EXPECT_NEAR(T_odom_robot.yaw_rad, 1.866, 0.001);
}

}  // namespace
}  // namespace swiftlet::interfaces
