// A condition that counts after some time.
#include "common/hysteresis.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

TEST(Hysteresis, EntersAndLeavesAfterItsTimes) {
  Hysteresis state(1.0, 2.0);
  const auto at = [&](double t_s, bool condition) { return state.update(condition, Time::fromSeconds(t_s)); };
  EXPECT_EQ(at(0.0, true), Edge::kNone);
  EXPECT_EQ(at(0.9, true), Edge::kNone);
  EXPECT_EQ(at(0.95, false), Edge::kNone) << "a moment without it starts anew";
  EXPECT_EQ(at(1.0, true), Edge::kNone);
  EXPECT_EQ(at(1.9, true), Edge::kNone);
  EXPECT_EQ(at(2.0, true), Edge::kEntered);
  EXPECT_EQ(state.since(), Time::fromSeconds(1.0));
  EXPECT_EQ(state.active_s(Time::fromSeconds(2.5)), 1.5);
  EXPECT_EQ(at(3.0, false), Edge::kNone);
  EXPECT_TRUE(state.active());
  EXPECT_EQ(at(5.0, false), Edge::kLeft);
  EXPECT_FALSE(state.active());
  EXPECT_EQ(state.active_s(Time::fromSeconds(6.0)), 0.0);
}

TEST(Hysteresis, WithoutTimesItIsTheCondition) {
  Hysteresis state;
  EXPECT_EQ(state.update(true, {}), Edge::kEntered);
  EXPECT_EQ(state.update(true, {}), Edge::kNone);
  EXPECT_EQ(state.update(false, {}), Edge::kLeft);
}

}  // namespace
}  // namespace swiftlet::common
