// A laser whose driver repeats its last scan, whose scans are late, or whose clock is wrong.
#include "autonomy/arrivals/scan_watch.hpp"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class ScanWatchStory : public testing::Test {
 protected:
  static constexpr double kPeriod_s = 0.025;

  /// The next scan, which arrives `late_s` after the time at which scans arrive usually, with a stamp that is
  /// `ahead_s` ahead.
  ScanWatch::Scan take(std::vector<float> ranges_m, double late_s = 0.0, double ahead_s = 0.0) {
    common::LaserScan scan;
    measured_ = common::Time::fromSeconds(now_s_ += kPeriod_s);
    scan.stamps = {measured_ + common::Duration::fromSeconds(ahead_s),
                   measured_ + common::Duration::fromSeconds(0.03 + late_s)};
    scan.range_min_m = 0.1;
    scan.range_max_m = 30.0;
    scan.ranges_m = std::move(ranges_m);
    return watch_.take(std::make_shared<const common::LaserScan>(scan));
  }
  bool repeats(std::vector<float> ranges_m) { return take(std::move(ranges_m)) == nullptr; }
  ScanWatch::Scan takeNoise(double late_s = 0.0, double ahead_s = 0.0) {
    return take({2.0F + 0.01F * static_cast<float>(++count_ % 7), 3.0F}, late_s, ahead_s);
  }
  std::string said() {
    std::string all;
    for (const common::Event& event : log_.take()) all += event.text + " (" + event.reason + ")\n";
    return all;
  }

  common::EventLog log_;
  ScanWatch watch_{kPeriod_s, log_};
  common::Time measured_;
  double now_s_ = 0.0;
  int count_ = 0;
};

TEST_F(ScanWatchStory, ScansWithNoiseNeverRepeat) {
  EXPECT_FALSE(repeats({2.0F, 3.0F, kInfinity}));
  EXPECT_FALSE(repeats({2.0F, 3.001F, kInfinity}));
  EXPECT_FALSE(repeats({2.0F, 3.0F, kInfinity}));
  EXPECT_TRUE(log_.take().empty());
}

TEST_F(ScanWatchStory, ARepeatedScanCountsAsNoneAndIsSaidOnce) {
  EXPECT_FALSE(repeats({2.0F, 3.0F}));
  EXPECT_TRUE(repeats({2.0F, 3.0F}));
  EXPECT_TRUE(log_.take().empty()) << "a scan given twice";
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(repeats({2.0F, 3.0F}));
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.front().severity, common::Severity::kWarning);
  EXPECT_FALSE(repeats({2.1F, 3.0F}));
  ASSERT_EQ(log_.take().size(), 1u) << "it measures again";
}

TEST_F(ScanWatchStory, LateScansKeepTheirStampsUntilTheyAreTooOld) {
  for (int i = 0; i < 80; ++i) ASSERT_TRUE(takeNoise());
  for (int i = 0; i < 20; ++i) {
    const ScanWatch::Scan scan = takeNoise(0.4);
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->stamps.measured, measured_);
  }
  EXPECT_EQ(said(), "the laser's scans are late (400 ms later than at first; those older than 0.9 s are rejected)\n");
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(takeNoise(1.5));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(takeNoise());
  EXPECT_EQ(said(), "the laser's scans come as at first ()\n");
}

TEST_F(ScanWatchStory, AJumpOfTheClockIsCorrectedWithinAQuarterOfASecond) {
  for (const double ahead_s : {0.3, -0.3, 0.06}) {
    for (int i = 0; i < 80; ++i) (void)takeNoise();
    (void)said();
    for (int i = 0; i < 10; ++i) (void)takeNoise(0.0, ahead_s);
    EXPECT_TRUE(said().starts_with("the laser's clock has jumped (it is")) << ahead_s;
    for (int i = 0; i < 40; ++i) {
      const ScanWatch::Scan scan = takeNoise(0.0, ahead_s);
      ASSERT_TRUE(scan) << ahead_s;
      EXPECT_NEAR((scan->stamps.measured - measured_).seconds(), 0.0, 1e-3) << ahead_s;
    }
  }
}

TEST_F(ScanWatchStory, ADriftOfTheClockIsNamedAndCorrected) {
  for (const double drift_s_s : {0.05, -0.05}) {
    for (int i = 0; i < 80; ++i) (void)takeNoise();
    (void)said();
    for (int i = 0; i < 120; ++i) {
      const ScanWatch::Scan scan = takeNoise(0.0, drift_s_s * kPeriod_s * i);
      if (i < 30) continue;
      ASSERT_TRUE(scan) << drift_s_s;
      EXPECT_NEAR((scan->stamps.measured - measured_).seconds(), 0.0, 2e-3) << drift_s_s;
    }
    EXPECT_TRUE(said().starts_with("the laser's clock drifts (it is 2")) << drift_s_s;
  }
}

TEST_F(ScanWatchStory, AnOpenPlaceWithoutAnyReturnIsSeenEveryTime) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(repeats({kInfinity, kInfinity, 31.0F}));
}

}  // namespace
}  // namespace swiftlet::autonomy
