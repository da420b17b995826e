#include "control/tick_clock.hpp"

#include <gtest/gtest.h>

namespace swiftlet::control {
namespace {

using common::Time;

TEST(TickClock, BoundsTheStepAfterAPauseAndOfARepeatedTime) {
  TickClock clock;
  EXPECT_EQ(clock.dt_s(), 0.01);
  clock.advance(Time::fromSeconds(100.0));
  EXPECT_EQ(clock.dt_s(), 0.01) << "the first tick has none before it";
  clock.advance(Time::fromSeconds(100.02));
  EXPECT_NEAR(clock.dt_s(), 0.02, 1e-12);
  clock.advance(Time::fromSeconds(160.0));
  EXPECT_NEAR(clock.dt_s(), 0.05, 1e-12);
  clock.advance(Time::fromSeconds(160.0));
  EXPECT_EQ(clock.dt_s(), 1e-3);
  EXPECT_EQ(clock.now(), Time::fromSeconds(160.0));
}

}  // namespace
}  // namespace swiftlet::control
