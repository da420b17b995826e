// Bags: the first topic with scans is read, from chunks of every compression; damaged parts are left out or reported.
#include <cmath>

#include <gmock/gmock.h>

#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "tests/interfaces/bag_bytes.hpp"
#include "tests/interfaces/support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ContainsRegex;
using testing::ElementsAre;

constexpr const char* kLaserScan = "sensor_msgs/LaserScan";

class Bag : public testing::Test {
 protected:
  std::unique_ptr<LaserLog> open(const std::string& bytes, const LaserLogOptions& options = {}) {
    put(folder_ / "a.bag", bytes);
    return openLaserLog(folder_ / "a.bag", options);
  }
  static int scansOf(LaserLog& log) {
    int scans = 0;
    while (log.next()) ++scans;
    return scans;
  }
  ScratchFolder folder_;
};

TEST_F(Bag, ReadsScansFromChunksOfEveryCompression) {
  for (const char* by : {"none", "bz2", "lz4"}) {
    const std::string records = bag_bytes::connection(3, "/front", kLaserScan) +
                                bag_bytes::message(3, 9, bag_bytes::scan({1.0F, 5.0F, NAN, -1.0F, 0.05F}));
    const auto log = open(bag_bytes::begin() + bag_bytes::chunk(records, by));
    const auto logged = log->next();
    ASSERT_TRUE(logged) << by;
    EXPECT_DOUBLE_EQ(logged->scan.stamps.measured.seconds(), 7.5) << "its own stamp, not that of the recording";
    EXPECT_DOUBLE_EQ(logged->scan.angle_min_rad, -1.0);
    EXPECT_DOUBLE_EQ(logged->scan.angle_increment_rad, 0.5);
    EXPECT_NEAR(logged->scan.time_increment.seconds(), 1e-4, 1e-9);
    EXPECT_FLOAT_EQ(logged->scan.ranges_m[0], 1.0F);
    EXPECT_TRUE(std::isinf(logged->scan.ranges_m[1])) << "its greatest range";
    EXPECT_TRUE(std::isnan(logged->scan.ranges_m[3])) << "negative";
    EXPECT_FLOAT_EQ(logged->scan.ranges_m[4], 0.05F);
    EXPECT_FALSE(logged->T_odom_robot);
    EXPECT_FALSE(log->next());
    EXPECT_EQ(log->counts().invalid_ranges, 2U);
    EXPECT_EQ(log->format(), "rosbag, /front");
    EXPECT_DOUBLE_EQ(log->progress(), 1.0);
  }
}

TEST_F(Bag, ReadsTheFirstTopicWithScansAndNamesTheOthers) {
  const std::string one = bag_bytes::scan({1.0F, 2.0F});
  const auto log =
      open(bag_bytes::begin() +
           bag_bytes::chunk(bag_bytes::connection(0, "/imu", "sensor_msgs/Imu") +
                            bag_bytes::connection(1, "/rear", kLaserScan) +
                            bag_bytes::connection(2, "/front", kLaserScan) + bag_bytes::message(0, 1, "anything") +
                            bag_bytes::message(2, 2, one) + bag_bytes::message(1, 3, one)) +
           bag_bytes::chunk(bag_bytes::message(2, 4, one), "bz2"));
  EXPECT_EQ(scansOf(*log), 2);
  EXPECT_EQ(log->format(), "rosbag, /front");
  EXPECT_THAT(log->notes(), ElementsAre("1 scans of /rear are left out, /front came first"));
}

TEST_F(Bag, ReversesClockwiseScans) {
  bag_bytes::Fan fan;
  fan.first_rad = 1.0F;
  fan.step_rad = -0.5F;
  const auto log =
      open(bag_bytes::begin() + bag_bytes::chunk(bag_bytes::connection(0, "/scan", kLaserScan) +
                                                 bag_bytes::message(0, 1, bag_bytes::scan({1.0F, 2.0F, 3.0F}, fan))));
  const auto logged = log->next();
  ASSERT_TRUE(logged);
  EXPECT_DOUBLE_EQ(logged->scan.angle_min_rad, 0.0);
  EXPECT_DOUBLE_EQ(logged->scan.angle_increment_rad, 0.5);
  EXPECT_THAT(logged->scan.ranges_m, ElementsAre(3.0F, 2.0F, 1.0F));
}

TEST_F(Bag, SkipsAndCountsUnusableScans) {
  bag_bytes::Fan wide, endless, nowhere;
  wide.step_rad = 4.0F;
  endless.range_max_m = INFINITY;
  nowhere.first_rad = NAN;
  const std::string cut = bag_bytes::scan({1.0F, 2.0F}).substr(0, 50), good = bag_bytes::scan({1.0F, 2.0F});
  std::string records = bag_bytes::connection(0, "/scan", kLaserScan);
  for (const std::string& data :
       {cut, bag_bytes::scan({1.0F, 2.0F, 3.0F}, wide), bag_bytes::scan({1.0F, 2.0F, 3.0F}, endless),
        bag_bytes::scan({1.0F, 2.0F, 3.0F}, nowhere), bag_bytes::scan(std::vector<float>(100'000, 1.0F)), std::string(),
        good})
    records += bag_bytes::message(0, 1, data);
  const auto log = open(bag_bytes::begin() + bag_bytes::chunk(records));
  EXPECT_EQ(scansOf(*log), 1);
  EXPECT_EQ(log->counts().skipped_records, 6U);
  EXPECT_THAT(log->counts().first_problems[1], ProblemIs("scan.spacing", "a.bag: /scan, message 2"));
  LaserLogOptions options;
  options.sensor = common::LaserConfig();
  EXPECT_EQ(scansOf(*open(bag_bytes::begin() + bag_bytes::chunk(records), options)), 4)
      << "--sensor mends the geometry";
}

TEST_F(Bag, DamageWithinAChunkDoesNotAffectTheNextChunk) {
  const std::string connection = bag_bytes::connection(0, "/scan", kLaserScan);
  const std::string message = bag_bytes::message(0, 1, bag_bytes::scan({1.0F, 2.0F}));
  for (const std::string by : {"none", "bz2", "lz4"}) {
    std::string damaged = bag_bytes::chunk(connection + message + bag_bytes::u32(0xffffffff) + message, by);
    const auto log = open(bag_bytes::begin() + damaged + bag_bytes::chunk(connection + message, by));
    EXPECT_EQ(scansOf(*log), 2) << by;
    EXPECT_EQ(log->counts().skipped_records, 1U);
    EXPECT_THAT(log->counts().first_problems.at(0), ProblemIs("bag.chunk-damaged"));
  }
  const std::string unknown = bag_bytes::record(5, {{"compression", "zpaq"}, {"size", bag_bytes::u32(9)}}, "whatever");
  const auto log = open(bag_bytes::begin() + unknown + bag_bytes::chunk(connection + message));
  EXPECT_EQ(scansOf(*log), 1);
  EXPECT_THAT(log->counts().first_problems.at(0), ProblemIs("bag.chunk-packing"));
}

TEST_F(Bag, ReadsATruncatedBagUpToItsEnd) {
  bag_bytes::Fan fine;
  fine.step_rad = 0.01F;
  const std::string records = bag_bytes::connection(0, "/scan", kLaserScan) +
                              bag_bytes::message(0, 1, bag_bytes::scan({1.0F, 2.0F})) +
                              bag_bytes::message(0, 2, bag_bytes::scan(std::vector<float>(100, 1.0F), fine));
  for (const std::string by : {"none", "bz2"}) {
    const std::string whole = bag_bytes::begin() + bag_bytes::chunk(records) + bag_bytes::chunk(records, by);
    const auto log = open(whole.substr(0, whole.size() - 100));
    int scans = 0;
    const auto problems = problemsOf([&] {
      while (log->next()) ++scans;
    });
    EXPECT_GE(scans, 2) << by;
    ASSERT_THAT(problems, ElementsAre(ProblemIs("file.damaged"))) << by;
    EXPECT_THAT(test_support::placeOf(problems[0]), ContainsRegex("a\\.bag: byte [0-9]+$")) << by;
  }
}

TEST_F(Bag, RefusesUnreadableFiles) {
  EXPECT_THAT(problemsOf([&] { open("#ROSBAG V1.2\n"); }), HasProblem("bag.other-version"));
  EXPECT_THAT(problemsOf([&] { (void)open(bag_bytes::begin())->next(); }), HasProblem("bag.no-scans"));
  const std::string encrypted = "#ROSBAG V2.0\n" + bag_bytes::record(3, {{"encryptor", "rosbag/AesCbcEncryptor"}}, "");
  EXPECT_THAT(problemsOf([&] { (void)open(encrypted)->next(); }), HasProblem("bag.encrypted"));
  const std::string other = bag_bytes::chunk(bag_bytes::connection(0, "/imu", "sensor_msgs/Imu") +
                                             bag_bytes::connection(1, "/scan", kLaserScan, "another layout") +
                                             bag_bytes::message(0, 1, "x") + bag_bytes::message(1, 1, "x"));
  EXPECT_THAT(problemsOf([&] { (void)open(bag_bytes::begin() + other)->next(); }),
              HasProblem("bag.no-scans", "a.bag", "/imu (sensor_msgs/Imu), /scan (sensor_msgs/LaserScan"));
  const std::string unknown = bag_bytes::record(5, {{"compression", "zpaq"}, {"size", bag_bytes::u32(9)}}, "whatever");
  EXPECT_THAT(problemsOf([&] {
                (void)open(bag_bytes::begin() + unknown + bag_bytes::connection(0, "/scan", kLaserScan))->next();
              }),
              HasProblem("bag.no-scans", "a.bag", "`zpaq`"));
}

TEST_F(Bag, ReportsMissingChunksAsTruncation) {
  const std::string chunk = bag_bytes::chunk(bag_bytes::connection(0, "/scan", kLaserScan) +
                                             bag_bytes::message(0, 1, bag_bytes::scan({1.0F, 2.0F})));
  EXPECT_EQ(scansOf(*open(bag_bytes::begin(2) + chunk + chunk)), 2);
  const auto log = open(bag_bytes::begin(2) + chunk);
  EXPECT_TRUE(log->next());
  EXPECT_THAT(problemsOf([&] { (void)log->next(); }), HasProblem("file.damaged", "", "1 of the 2"));
}

TEST_F(Bag, ManyRecordsDoNotExhaustTheStack) {
  std::string bytes = bag_bytes::begin();
  for (int i = 0; i < 200'000; ++i) bytes += bag_bytes::record(6, {}, "");
  EXPECT_THAT(problemsOf([&] { (void)open(bytes)->next(); }), HasProblem("bag.no-scans"));
}

// Recorded by hand-held laser; its indices have the wrong length that an old rosbag wrote.
TEST_F(Bag, ReadsACompressedRecordedBag) {
  const auto file = test_support::dataSet("01-laser-slam/ccny-handheld/ccny_laser_scan_matcher_demo.bag.gz");
  if (!file) return;
  const auto log = openLaserLog(*file);
  auto logged = log->next();
  ASSERT_TRUE(logged);
  EXPECT_EQ(logged->scan.stamps.measured.nanoseconds(), 1282836370'970876375);
  EXPECT_EQ(logged->scan.ranges_m.size(), 681U);
  EXPECT_NEAR(logged->scan.angle_min_rad, -119.5 * common::kRadPerDeg, 0.001);
  EXPECT_NEAR(logged->scan.angle_increment_rad, 2.0 * M_PI / 1024.0, 1e-6);
  EXPECT_NEAR(logged->scan.range_max_m, 5.6, 1e-6);
  common::Time last = logged->scan.stamps.measured;
  while ((logged = log->next())) {
    EXPECT_EQ(logged->scan.ranges_m.size(), 681U);
    EXPECT_GT(logged->scan.stamps.measured, last);
    last = logged->scan.stamps.measured;
  }
  EXPECT_EQ(log->counts().scans, 360U) << "as librosbag-storage counts";
  EXPECT_EQ(log->counts().skipped_records, 0U);
  EXPECT_NEAR((last - common::Time::fromNanoseconds(1282836370'970876375)).seconds(), 36.0, 1.0);
  EXPECT_EQ(log->format(), "rosbag, /scan");
}

}  // namespace
}  // namespace swiftlet::interfaces
