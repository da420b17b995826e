// The flight away from the walls ends by time, and never leads far.
#include "control/blind_escape.hpp"

#include <gtest/gtest.h>

namespace swiftlet::control {
namespace {

using common::Time;

TEST(BlindEscape, FliesItsDisplacementByTime) {
  BlindEscape escape;
  escape.plan({0.0, -0.3});
  EXPECT_FALSE(escape.active());
  const auto length_m = escape.start(Time::fromSeconds(5.0), 0.01);
  ASSERT_TRUE(length_m);
  EXPECT_NEAR(*length_m, 0.3, 1e-12);
  EXPECT_NEAR((escape.velocity_map_m_s() - Eigen::Vector2d(0.0, -BlindEscape::kSpeed_m_s)).norm(), 0.0, 1e-12);
  EXPECT_FALSE(escape.flown(Time::fromSeconds(5.9)));
  EXPECT_TRUE(escape.flown(Time::fromSeconds(6.01)));
  EXPECT_TRUE(escape.active()) << "until its flight is ended";
  escape.end();
  EXPECT_FALSE(escape.active());
  EXPECT_FALSE(escape.flown(Time::fromSeconds(9.0)));
}

TEST(BlindEscape, IsNoLongerThanItsReachAndStaysWithoutAPlan) {
  BlindEscape escape;
  EXPECT_FALSE(escape.start(Time::fromSeconds(5.0), 0.01));
  EXPECT_FALSE(escape.active());
  escape.plan({0.002, 0.0});
  EXPECT_FALSE(escape.start(Time::fromSeconds(5.0), 0.01)) << "less than one tick's";
  escape.plan({3.0, 4.0});
  EXPECT_EQ(*escape.start(Time::fromSeconds(5.0), 0.01), BlindEscape::kReach_m);
}

}  // namespace
}  // namespace swiftlet::control
