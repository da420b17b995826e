#include "interfaces/laser_log/laser_log.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "interfaces/laser_log/carmen.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "tests/interfaces/support.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::ProblemIs;

std::string oldScan(int beams, const std::string& range = "2.5", const std::string& stamp = "976052857.337530") {
  std::string line = "FLASER " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " " + range;
  return line + " 0.96 2.0 0.0 1.0 2.0 0.0 " + stamp + " host 1.0";
}

CarmenScan read(const std::string& line) {
  auto scan = parseCarmenLine(line);
  EXPECT_TRUE(scan && *scan) << line;
  return **scan;
}

/// The scan with mount and odometry, as the log reader returns it.
std::optional<LoggedScan> logged(const std::string& line, const LaserLogOptions& options = {}) {
  const ScratchFolder folder;
  put(folder / "a.log", line + "\n");
  return openLaserLog(folder / "a.log", options)->next();
}

TEST(Carmen, AnOldScanCoversHalfATurn) {
  for (const auto& [beams, step_deg] : {std::pair{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}}) {
    const CarmenScan scan = read(oldScan(beams));
    EXPECT_EQ(scan.scan.ranges_m.size(), static_cast<std::size_t>(beams));
    EXPECT_DOUBLE_EQ(scan.scan.angle_min_rad, -0.5 * std::numbers::pi);
    EXPECT_NEAR(scan.scan.angle_increment_rad, step_deg * std::numbers::pi / 180.0, 1e-12);
  }
}

TEST(Carmen, ReadsTheLaserMountTheOdometryAndTheStamp) {
  const auto scan = logged(oldScan(180));
  EXPECT_NEAR(scan->T_robot_laser.x_m, -0.04, 1e-12);
  EXPECT_DOUBLE_EQ(scan->T_odom_robot->x_m, 1.0);
  EXPECT_EQ(scan->scan.stamps.measured.nanoseconds(), 976052857'337530000);
}

TEST(Carmen, ANewScanDescribesItsLaser) {
  const auto scan =
      logged("ROBOTLASER1 0 -1.0 2.0 0.5 50.0 0.1 0 3 1.0 50.0 2.0 1 7.0 1 2 0 1 2 0 0.1 0.2 0 0 0 12.5 host 1.0");
  EXPECT_DOUBLE_EQ(scan->scan.angle_min_rad, -1.0);
  EXPECT_DOUBLE_EQ(scan->scan.angle_increment_rad, 0.5);
  EXPECT_THAT(scan->scan.ranges_m, testing::ElementsAre(1.0F, INFINITY, 2.0F));
  EXPECT_DOUBLE_EQ(scan->scan.stamps.measured.seconds(), 12.5);
}

TEST(Carmen, AMissingReturnIsInfiniteAndAnInvalidRangeIsNan) {
  for (const char* no_return : {"81.91", "81.83", "51.2", "50.00", "inf"})
    EXPECT_TRUE(std::isinf(logged(oldScan(3, no_return))->scan.ranges_m[1])) << no_return;
  for (const char* wrong : {"nan", "-1.0"})
    EXPECT_TRUE(std::isnan(logged(oldScan(3, wrong))->scan.ranges_m[1])) << wrong;
}

TEST(Carmen, OtherLinesAreNotScans) {
  for (const char* line :
       {"", "# FLASER", "ODOM 1 2 3 0 0 0 1.0 host 1.0", "PARAM robot_width 0.4 1 host 1", "FLASERS 1"}) {
    const auto scan = parseCarmenLine(line);
    ASSERT_TRUE(scan) << line;
    EXPECT_FALSE(*scan) << line;
  }
}

TEST(Carmen, ReportsThePlaceOfATruncatedLine) {
  const auto cut = parseCarmenLine("FLASER 3 1.0 2.0");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().element, "range");
  const auto word = parseCarmenLine("FLASER 3 1.0 two 2.0 0 0 0 0 0 0 1.0 host 1.0");
  ASSERT_FALSE(word);
  EXPECT_EQ(word.error().column, 14);
  EXPECT_EQ(word.error().message.name(), "text.not-a-number");
  EXPECT_FALSE(parseCarmenLine("FLASER -3 1.0"));
  EXPECT_FALSE(parseCarmenLine("FLASER 1e9 1.0"));
  EXPECT_FALSE(parseCarmenLine("FLASER 1 1.0 nan 0 0 0 0 0 1.0 host 1.0"));
}

TEST(Carmen, ReportsAWrongCountOfRanges) {
  const std::string rest = " 1.0 1.0 1.0 1.0 1.0 1.0 0 0 0 0 0 0 976052857.3 host 1.0";
  EXPECT_TRUE(parseCarmenLine("FLASER 6" + rest));
  for (const char* wrong : {"0", "3", "4", "5", "7", "8", "9"})
    EXPECT_FALSE(parseCarmenLine("FLASER " + std::string(wrong) + rest)) << wrong;
  const std::string front = "ROBOTLASER1 0 -1.0 2.0 0.5 50.0 0.1 0 ", back = " 1 2 0 1 2 0 0.1 0.2 0 0 0 12.5 host 1.0";
  EXPECT_TRUE(parseCarmenLine(front + "3 1.0 1.0 1.0 2 7 7" + back));
  EXPECT_FALSE(parseCarmenLine(front + "3 1.0 1.0 1.0 1 7 7" + back));
  EXPECT_FALSE(parseCarmenLine(front + "3 1.0 1.0 1.0 3 7 7" + back));
  const auto more = parseCarmenLine("FLASER 6" + rest + " 2.0");
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().message.name(), "laser-log.line-goes-on");
}

TEST(Carmen, ALineTruncatedWithinItsStampsIsNotAScan) {
  const std::string line = oldScan(3);
  for (const char* last : {"976052857.337530", "97605", "ho"})
    EXPECT_FALSE(parseCarmenLine(line.substr(0, line.find(last == std::string("97605") ? "2857" : last) + 2))) << last;
}

TEST(Carmen, ASensorOverridesTheGeometry) {
  common::LaserConfig sensor;
  sensor.field_of_view_deg = 240.0;
  sensor.range_max_m = 5.6;
  const auto scan = logged(oldScan(3, "5.7"), {sensor});
  EXPECT_NEAR(scan->scan.angle_increment_rad, 120.0 * common::kRadPerDeg, 1e-12);
  EXPECT_TRUE(std::isinf(scan->scan.ranges_m[0]));
  EXPECT_DOUBLE_EQ(scan->T_robot_laser.x_m, 0.0);
}

TEST(LaserLog, SkipsAndCountsBadRecordsWithTheirPlace) {
  const ScratchFolder folder;
  put(folder / "a.log", "# message\n" + oldScan(3) + "\nFLASER 3 1.0\n" + oldScan(4, "nan") + "\n");
  const auto log = openLaserLog(folder / "a.log");
  EXPECT_EQ(log->next()->scan.ranges_m.size(), 3U);
  EXPECT_EQ(log->next()->scan.ranges_m.size(), 4U);
  EXPECT_FALSE(log->next());
  EXPECT_EQ(log->counts().scans, 2U);
  EXPECT_EQ(log->counts().skipped_records, 1U);
  EXPECT_EQ(log->counts().invalid_ranges, 4U);
  ASSERT_EQ(log->counts().first_problems.size(), 1U);
  EXPECT_EQ(log->counts().first_problems[0].location.line, 3);
  EXPECT_DOUBLE_EQ(log->progress(), 1.0);
}

TEST(Carmen, TellsGarbledLinesFromKnownOnes) {
  for (const char* line : {"", "  \r", "# FLASER\x80", "ODOM 1 2 3\t0", "PARAM robot_width 0.4", "NEFF 4", "RLASER 1",
                           "LLASER 1", "FLASERS 1", "ROBOTLASER2 1", "VERTEX2 0 1 2 3", "GPS_2 $GPGGA,1"})
    EXPECT_FALSE(isGarbledCarmenLine(line)) << line;
  for (const char* line :
       {"FLA\xd3"
        "ER 180 1.0",
        "3.42 3.43 3.45", "ODOM 1 2 \x01 3", "flaser 3 1.0", "FLASFR 3 1.0 1.0 1.0", "FL@SER 3", "ROBOTLASFR1 0"})
    EXPECT_TRUE(isGarbledCarmenLine(line)) << line;
}

TEST(LaserLog, CountsGarbledLinesWithTheirPlace) {
  const ScratchFolder folder;
  std::string flipped = oldScan(3);
  flipped[2] ^= 0x10;
  put(folder / "a.log", oldScan(3) + "\n" + flipped + "\n1.2 3.4\nODOM 1 2 3\n\n" + oldScan(3) + "\n");
  const auto log = openLaserLog(folder / "a.log");
  EXPECT_TRUE(log->next());
  EXPECT_TRUE(log->next());
  EXPECT_FALSE(log->next());
  EXPECT_EQ(log->counts().skipped_records, 2U);
  ASSERT_EQ(log->counts().first_problems.size(), 2U);
  EXPECT_EQ(log->counts().first_problems[0].location.line, 2);
  EXPECT_EQ(log->counts().first_problems[1].location.line, 3);
}

TEST(LaserLog, MessagesQuoteWordsShortenedAndPrintable) {
  const ScratchFolder folder;
  put(folder / "a.log", "FLASER 1 \x1b[2J" + std::string(500, '\xff') + "\n");
  const auto log = openLaserLog(folder / "a.log");
  EXPECT_FALSE(log->next());
  EXPECT_THAT(log->counts().first_problems.at(0),
              ProblemIs("text.not-a-number", "a.log:1:10: range", "`?[2J" + std::string(36, '?') + "...`"));
}

TEST(LaserLog, SaysWhichUnitStampsSince1970AreIn) {
  const ScratchFolder folder;
  put(folder / "a.log", oldScan(3, "2.5", "1600000000000000000") + "\n");
  const auto log = openLaserLog(folder / "a.log");
  EXPECT_FALSE(log->next());
  EXPECT_THAT(log->counts().first_problems.at(0), ProblemIs("text.not-a-time", "ipc_timestamp", "1e9"));
}

TEST(LaserLog, SkipsImpossibleLaserGeometry) {
  const ScratchFolder folder;
  const std::string rest = " 50.0 0.1 0 3 1.0 50.0 2.0 0 1 2 0 1 2 0 0.1 0.2 0 0 0 12.5 host 1.0\n";
  put(folder / "a.log", "ROBOTLASER1 0 -1.0 0.0 0.0" + rest + "ROBOTLASER1 0 -1.0 2.0 4.0" + rest +
                            "ROBOTLASER1 0 -99 2.0 0.1" + rest + "ROBOTLASER1 0 -1.0 2.0 0.0" + rest);
  const auto log = openLaserLog(folder / "a.log");
  EXPECT_DOUBLE_EQ(log->next()->scan.angle_increment_rad, 1.0) << "of the field of view";
  EXPECT_FALSE(log->next());
  EXPECT_EQ(log->counts().skipped_records, 3U);
  EXPECT_THAT(log->counts().first_problems.at(1), ProblemIs("scan.spacing", "a.log:2:1"));
}

TEST(LaserLog, RefusesFilesThatAreNotLogs) {
  const ScratchFolder folder;
  EXPECT_THROW((void)openLaserLog(folder / "missing.log"), common::InputError);
  for (const char* text : {"", "no log\nat all\n"}) {
    put(folder / "b.log", text);
    EXPECT_THROW((void)openLaserLog(folder / "b.log"), common::InputError);
  }
}

}  // namespace
}  // namespace swiftlet::interfaces
