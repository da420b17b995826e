#include "autonomy/arrivals/scan_queue.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

constexpr double kPeriod_s = 0.025;

std::shared_ptr<const common::LaserScan> scan(int number, double arrived_s) {
  auto made = std::make_shared<common::LaserScan>();
  made->stamps = {Time::fromSeconds(number * kPeriod_s), Time::fromSeconds(arrived_s)};
  return made;
}

int numberOf(const common::LaserScan& scan) {
  return static_cast<int>(std::lround(scan.stamps.measured.seconds() / kPeriod_s));
}

struct Queue {
  ScanQueue queue{{.latency_s = 0.004, .reorder_wait_s = 0.03}, kPeriod_s};

  std::vector<int> takeUntil(double now_s) {
    std::vector<int> numbers;
    while (const auto taken = queue.take(Time::fromSeconds(now_s))) numbers.push_back(numberOf(*taken));
    return numbers;
  }
};

TEST(ScanQueue, GivesScansInOrderOnceTheyAreProcessed) {
  Queue q;
  q.queue.add(scan(1, 0.050));
  EXPECT_TRUE(q.takeUntil(0.053).empty());
  EXPECT_EQ(q.takeUntil(0.055), std::vector{1});
  q.queue.add(scan(2, 0.075));
  EXPECT_EQ(q.takeUntil(0.080), std::vector{2});
}

TEST(ScanQueue, ScansThatOvertookEachOtherArePutInOrder) {
  Queue q;
  q.queue.add(scan(1, 0.050));
  EXPECT_EQ(q.takeUntil(0.060), std::vector{1});
  q.queue.add(scan(3, 0.100));
  EXPECT_TRUE(q.takeUntil(0.105).empty()) << "scan 2 may still come";
  q.queue.add(scan(2, 0.106));
  EXPECT_EQ(q.takeUntil(0.111), (std::vector{2, 3}));
  EXPECT_EQ(q.queue.lateScans(), 0u);
}

TEST(ScanQueue, WaitsNoLongerThanTheLimitForALostScan) {
  Queue q;
  q.queue.add(scan(1, 0.050));
  EXPECT_EQ(q.takeUntil(0.060), std::vector{1});
  q.queue.add(scan(3, 0.100));
  EXPECT_TRUE(q.takeUntil(0.133).empty());
  EXPECT_EQ(q.takeUntil(0.135), std::vector{3});
}

TEST(ScanQueue, AScanOlderThanTheLastOneIsCountedAndLeftOut) {
  Queue q;
  q.queue.add(scan(3, 0.080));
  EXPECT_EQ(q.takeUntil(0.085), std::vector{3});
  EXPECT_FALSE(q.queue.add(scan(2, 0.086)));
  EXPECT_FALSE(q.queue.add(scan(3, 0.087)));
  EXPECT_TRUE(q.queue.add(scan(4, 1.5)));
  EXPECT_NEAR(q.queue.lastMeasured().seconds(), 3 * kPeriod_s, 1e-9);
  EXPECT_TRUE(q.takeUntil(1.0).empty());
  EXPECT_EQ(q.queue.lateScans(), 2u);
}

}  // namespace
}  // namespace swiftlet::autonomy
