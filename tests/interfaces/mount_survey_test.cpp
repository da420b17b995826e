// The mount of the laser, from records whose two poses may coincide, differ, or have different origins.
#include "interfaces/laser_log/mount_survey.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "tests/interfaces/support.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Pose2;
using testing::ElementsAre;
using testing::HasSubstr;

const Pose2 kMount{0.2, -0.1, 3.1};

/// Along an arc of 0.1 m a step.
Pose2 poseAt(int i) { return Pose2{3.0, 2.0, -3.0} * Pose2{std::sin(0.1 * i), 1.0 - std::cos(0.1 * i), 0.1 * i}; }

TEST(MountSurvey, TheMountIsTheOneOfMostRecords) {
  MountSurvey survey;
  for (int i = 0; !survey.decided(); ++i)
    survey.add(i == 3 ? Pose2{9, 9, 9} : poseAt(i) * kMount * Pose2{0.005 * std::cos(i), 0.0, 0.005}, poseAt(i));
  const LaserMount mount = survey.result();
  EXPECT_TRUE(mount.rigid);
  EXPECT_NEAR(mount.T_robot_laser.x_m, kMount.x_m, 0.006);
  EXPECT_NEAR(mount.T_robot_laser.y_m, kMount.y_m, 0.006);
  EXPECT_NEAR(common::wrapAngle(mount.T_robot_laser.yaw_rad - kMount.yaw_rad), 0.005, 1e-9)
      << "beyond half a turn, too";
  EXPECT_FALSE(agrees({9, 9, 9}, mount));
}

TEST(MountSurvey, WaitsForMotionBeforeItDecides) {
  MountSurvey survey;
  for (int i = 0; i < 100; ++i) survey.add({}, {});
  EXPECT_FALSE(survey.decided());
  for (int i = 0; i < 5000; ++i) survey.add({}, {});
  EXPECT_TRUE(survey.decided()) << "but not for ever";
  EXPECT_TRUE(survey.result().rigid);
  EXPECT_TRUE(MountSurvey().result().rigid) << "no records, nothing odd";
}

TEST(MountSurvey, PosesWithDifferentOriginsGiveNoRigidMount) {
  MountSurvey survey;
  // One pose is corrected, the other is raw odometry that drifts away from it.
  for (int i = 0; !survey.decided(); ++i) survey.add(poseAt(i) * Pose2{0.02 * i, 0, 0.01 * i}, poseAt(i));
  EXPECT_FALSE(survey.result().rigid);
  EXPECT_FALSE(survey.result().robot_stands);
  EXPECT_DOUBLE_EQ(survey.result().T_robot_laser.x_m, 0.0);
}

TEST(MountSurvey, ReportsRobotPosesThatNeverChange) {
  MountSurvey survey;
  for (int i = 0; !survey.decided(); ++i) survey.add(poseAt(i), {});
  EXPECT_FALSE(survey.result().rigid);
  EXPECT_TRUE(survey.result().robot_stands);
}

std::string record(const Pose2& laser, const Pose2& robot, int i) {
  std::string line = "FLASER 2 1 1";
  for (const double value : {laser.x_m, laser.y_m, laser.yaw_rad, robot.x_m, robot.y_m, robot.yaw_rad})
    line += " " + std::to_string(value);
  return line + " " + std::to_string(i) + " host 1\n";
}

TEST(CarmenMount, IsTheSameForTheWholeLog) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 40; ++i) text += record(i == 30 ? Pose2{} : poseAt(i) * Pose2{-0.04, 0, 0}, poseAt(i), i);
  put(folder / "a", text);
  const auto log = openLaserLog(folder / "a");
  std::optional<LoggedScan> logged;
  for (int i = 0; (logged = log->next()); ++i) {
    EXPECT_NEAR(logged->T_robot_laser.x_m, -0.04, 1e-5);
    EXPECT_NEAR(logged->T_odom_robot->x_m, poseAt(i).x_m, 1e-5);
  }
  EXPECT_THAT(log->notes(), ElementsAre(HasSubstr("1 of the records have the laser elsewhere on the robot")));
}

TEST(CarmenMount, UsesTheLaserPoseAsOdometryWhenTheRobotPoseNeverChanges) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 40; ++i) text += record(poseAt(i), {}, i);
  put(folder / "a", text);
  const auto log = openLaserLog(folder / "a");
  (void)log->next();
  EXPECT_NEAR(log->next()->T_odom_robot->x_m, poseAt(1).x_m, 1e-5);
  EXPECT_THAT(log->notes(), ElementsAre(HasSubstr("keep no distance"), HasSubstr("never changes")));
}

struct Known {
  const char* file;
  std::uint64_t scans;
  std::size_t beams;
  double laser_x_m;
};

// In all available logs, corrected ones included, the mount is constant.
TEST(CarmenMount, IsRigidInRecordedLogs) {
  for (const Known& known :
       {Known{"acapulco/acapulco-corrected.log.gz", 861, 181, 0.0},
        Known{"edmonton/edmonton-corrected.log.gz", 340, 180, 0.0},
        Known{"fhw-museum/fhw-corrected.log.gz", 488, 180, 0.0},
        Known{"fr-campus/freiburg-campus-corrected.log.gz", 2008, 360, 0.0},
        Known{"fr079/flirtlib-fr079.log.gz", 1464, 360, -0.04}, Known{"fr079/fr079.clf.bz2", 4934, 360, -0.04},
        Known{"fr079/freiburg-079-corrected.log.gz", 4791, 360, 0.0},
        Known{"intel/flirtlib-intel-lab.log.gz", 2672, 180, 0.0}, Known{"intel/intel.clf.bz2", 13631, 180, 0.0},
        Known{"mit-csail/flirtlib-mit-cscail.log.gz", 1051, 361, 0.0},
        Known{"mit-csail/mit-csail.clf.bz2", 1988, 361, 0.0}, Known{"orebro/orebro-corrected.log.gz", 237, 181, 0.0}}) {
    const auto file = test_support::dataSet(std::string("01-laser-slam/") + known.file);
    if (!file) return;
    const auto log = openLaserLog(*file);
    while (const auto logged = log->next()) {
      EXPECT_EQ(logged->scan.ranges_m.size(), known.beams) << known.file;
      EXPECT_NEAR(logged->T_robot_laser.x_m, known.laser_x_m, 1e-5) << known.file;
    }
    EXPECT_EQ(log->counts().scans, known.scans) << known.file;
    EXPECT_EQ(log->counts().skipped_records, 0U) << known.file;
    EXPECT_THAT(log->notes(), testing::IsEmpty()) << known.file;
  }
}

}  // namespace
}  // namespace swiftlet::interfaces
