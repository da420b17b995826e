// A laser whose driver repeats its last scan.
#include "autonomy/arrivals/scan_watch.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class ScanWatchStory : public testing::Test {
 protected:
  bool repeats(std::vector<float> ranges_m) {
    common::LaserScan scan;
    scan.stamps.arrived = scan.stamps.measured = common::Time::fromSeconds(now_s_ += 0.025);
    scan.range_min_m = 0.1;
    scan.range_max_m = 30.0;
    scan.ranges_m = std::move(ranges_m);
    return watch_.repeats(scan);
  }

  common::EventLog log_;
  ScanWatch watch_{log_};
  double now_s_ = 0.0;
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

TEST_F(ScanWatchStory, AnOpenPlaceWithoutAnyReturnIsSeenEveryTime) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(repeats({kInfinity, kInfinity, 31.0F}));
}

}  // namespace
}  // namespace swiftlet::autonomy
