// The time left that long commands show.
#include "apps/time_left.hpp"

#include <gtest/gtest.h>

namespace swiftlet::apps {
namespace {

TEST(TimeLeft, IsThatOfTheSpeedSoFar) {
  TimeLeft left;
  for (int step = 1; step < 1000; ++step) {
    const auto left_s = left.after(step / 1000.0, 0.1 * step);
    if (step > 21) {
      ASSERT_TRUE(left_s.has_value()) << step;
      EXPECT_NEAR(*left_s, 100.0 - 0.1 * step, 5.0) << step;
    }
  }
}

/// A file of ten blocks, each taken at once and worked on for ten seconds.
TEST(TimeLeft, RunsDownWhileABlockOfTheInputIsWorkedOn) {
  TimeLeft left;
  for (int second = 0; second < 100; ++second) {
    const auto left_s = left.after(0.1 * (second / 10 + 1), second);
    if (second < 10)
      EXPECT_FALSE(left_s.has_value()) << "no block is done at " << second;
    else
      EXPECT_NEAR(left_s.value_or(0.0), 100.0 - second, 1e-6);
  }
}

TEST(TimeLeft, IsNotToldWhereTheRunLastsLonger) {
  TimeLeft left;
  left.after(0.5, 1.0);
  EXPECT_NEAR(left.after(0.9, 10.0).value_or(0.0), 10.0, 1e-6);
  EXPECT_FALSE(left.after(0.9, 21.0).has_value());
}

}  // namespace
}  // namespace swiftlet::apps
