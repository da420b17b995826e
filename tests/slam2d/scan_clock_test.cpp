#include "perception/laser_odometry/scan_clock.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

using common::Time;

TEST(ScanClock, KeepsIncreasingStamps) {
  ScanClock clock;
  for (const double stamp_s : {100.0, 100.2, 100.5, 107.0})
    EXPECT_EQ(clock.tick(Time::fromSeconds(stamp_s)), Time::fromSeconds(stamp_s));
  EXPECT_EQ(clock.unreliable(), 0U);
}

TEST(ScanClock, ReplacesALateStampByTheUsualInterval) {
  ScanClock clock;
  for (int i = 0; i < 50; ++i) (void)clock.tick(Time::fromSeconds(0.2 * i));
  const Time repeated = clock.tick(Time::fromSeconds(0.2 * 49));
  EXPECT_EQ(clock.unreliable(), 1U);
  EXPECT_NEAR(repeated.seconds(), 0.2 * 50, 0.01);
}

TEST(ScanClock, EqualStampsAdvanceByOneSecondEach) {
  ScanClock clock;
  Time last;
  for (int i = 0; i < 200; ++i) {
    const Time now = clock.tick(Time());
    if (i > 0) {
      EXPECT_NEAR((now - last).seconds(), 1.0, 1e-9);
    }
    last = now;
  }
  EXPECT_EQ(clock.unreliable(), 199U);
}

/// Scans every 0.2 s, stamped up to half a second late, so that one in three stamps goes back.
TEST(ScanClock, StampsThatGoBackKeepTheMeanInterval) {
  ScanClock clock;
  Time last;
  for (int i = 0; i < 2000; ++i) {
    const double late_s = 0.25 + 0.25 * std::sin(2.4 * i);
    const Time now = clock.tick(Time::fromSeconds(0.2 * i + late_s));
    if (i > 0) {
      EXPECT_GT(now, last);
    }
    last = now;
  }
  EXPECT_GT(clock.unreliable(), 300U);
  EXPECT_NEAR(last.seconds(), 0.2 * 2000, 0.05 * 400);
}

/// Scans every 0.2 s, stamped when they came: every third is held up, until the next two come with it.
TEST(ScanClock, StampsInBurstsKeepTheMeanInterval) {
  ScanClock clock;
  Time last, last_stamp;
  for (int i = 0; i < 2000; ++i) {
    const double late_s = 0.2 * (2 - i % 3) + 0.001 * (i % 3);
    const Time stamp = Time::fromSeconds(0.2 * i + late_s);
    EXPECT_TRUE(i == 0 || stamp > last_stamp);
    const Time now = clock.tick(last_stamp = stamp);
    if (i > 50) {
      EXPECT_NEAR((now - last).seconds(), 0.2, 0.02) << i;
    }
    last = now;
  }
  EXPECT_GT(clock.unreliable(), 1000U);
}

/// Delays of up to 1.75 times the interval, but never a stamp before the one before it, or within 6 ms.
TEST(ScanClock, CorrectsLateStampsThatStillIncrease) {
  ScanClock clock;
  Time last;
  double stamp_s = -1.0;
  for (int i = 0; i < 2000; ++i) {
    stamp_s = std::max(stamp_s + 0.006, 0.2 * i + 0.175 + 0.175 * std::sin(2.4 * i));
    const Time now = clock.tick(Time::fromSeconds(stamp_s));
    if (i > 50) {
      EXPECT_NEAR((now - last).seconds(), 0.2, 0.03) << i;
    }
    last = now;
  }
  EXPECT_GT(clock.unreliable(), 200U);
}

TEST(ScanClock, KeepsStampsAcrossPausesAndMissingScans) {
  ScanClock clock;
  double stamp_s = 0.0;
  for (int i = 0; i < 1000; ++i) {
    stamp_s += i % 100 == 99 ? 60.0 : i % 7 == 0 ? 0.4 : i % 2 == 0 ? 0.19 : 0.21;
    EXPECT_EQ(clock.tick(Time::fromSeconds(stamp_s)), Time::fromSeconds(stamp_s));
  }
  EXPECT_EQ(clock.unreliable(), 0U);
}

TEST(ScanClock, LimitsExtremeStampsToPausesOfAnHour) {
  ScanClock clock;
  Time last = clock.tick(Time::fromSeconds(-4.5e9));
  for (const double stamp_s : {4.5e9, -4.5e9, 4.5e9, -4.5e9, 4.5e9, 4.5e9 + 0.2}) {
    const Time now = clock.tick(Time::fromSeconds(stamp_s));
    EXPECT_GT(now, last);
    EXPECT_LE((now - last).seconds(), 3600.0);
    last = now;
  }
  EXPECT_EQ(clock.unreliable(), 3U);
}

}  // namespace
}  // namespace swiftlet::perception
