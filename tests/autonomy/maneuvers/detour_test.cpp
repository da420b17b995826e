// Detour: when it is due, what it flies, and when it is over.
#include <gtest/gtest.h>

#include "autonomy/maneuvers/detour.hpp"
#include "tests/autonomy/maneuvers/workbench.hpp"

namespace swiftlet::autonomy {
namespace {

class DetourTest : public ManeuverWorkbench {
 protected:
  common::Time in(double seconds) const { return now_ + common::Duration::fromSeconds(seconds); }
  void begin() {
    detour_.ask(input(), {6.0, 2.0}, std::nullopt);
    deliver();
    detour_.begin({straight(position_m(), {3.0, 2.0}), false}, "a wall", now_, state_);
  }
  PathFlight flight_{setup_, common::FlightMode::kFast};
  Detour detour_{setup_, flight_};
};

TEST_F(DetourTest, IsDueAfterSomeTimeWithoutAPathOrAFlownPlan) {
  EXPECT_FALSE(detour_.due(now_, in(2.4), std::nullopt));
  EXPECT_TRUE(detour_.due(now_, in(2.6), std::nullopt));
  flight_.offer(straight(position_m(), {3.0, 2.0}), now_, state_);
  EXPECT_FALSE(detour_.due(now_, in(2.6), std::nullopt));
}

TEST_F(DetourTest, IsRequestedFromTheDeskAndNotRepeatedAtOnce) {
  answers_.clear();
  detour_.ask(input(), {6.0, 2.0}, std::nullopt);
  EXPECT_FALSE(flight_.mayAsk());
  deliver();
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_TRUE(answers_[0].detour);
  EXPECT_FALSE(detour_.active()) << "the maneuver begins it with the answer";
  EXPECT_FALSE(detour_.due(now_, in(2.4), std::nullopt)) << "even where there was nowhere to go";
  EXPECT_TRUE(detour_.due(now_, in(2.6), std::nullopt));
}

TEST_F(DetourTest, IsFlownAndEndsAtItsTarget) {
  begin();
  EXPECT_TRUE(detour_.active());
  const common::Event event = lastEvent();
  EXPECT_EQ(event.text, "moves closer to look");
  EXPECT_EQ(event.reason, "a wall");
  runUntil(
      [this] {
        detour_.endWhenOver(input());
        return !detour_.active();
      },
      10.0);
  EXPECT_LT(distanceTo_m({3.0, 2.0}), 0.16);
  EXPECT_FALSE(flight_.plan());
  EXPECT_FALSE(detour_.due(now_, in(2.4), std::nullopt)) << "the next one counts from its end";
}

TEST_F(DetourTest, EndsWhenItLosesItsPath) {
  follows_ = false;
  begin();
  detour_.endWhenOver(input());
  EXPECT_TRUE(detour_.active());
  controller_.hold();
  detour_.endWhenOver(input());
  EXPECT_FALSE(detour_.active());
}

TEST_F(DetourTest, OneIsEnoughToWaitForWhatMayGo) {
  EXPECT_TRUE(detour_.due(now_, in(10.0), Eigen::Vector2d(4.0, 2.0)));
  begin();
  controller_.hold();
  detour_.endWhenOver(input());
  EXPECT_FALSE(detour_.due(now_, in(10.0), Eigen::Vector2d(4.0, 2.0)));
  EXPECT_TRUE(detour_.due(now_, in(10.0), std::nullopt)) << "what will not go is looked at from two places";
  detour_.breakOff();
  EXPECT_TRUE(detour_.due(now_, in(10.0), Eigen::Vector2d(4.0, 2.0))) << "there was a path since";
}

TEST_F(DetourTest, WhatStandsElsewhereIsLookedAtAsWell) {
  const Eigen::Vector2d door(4.0, 2.0);
  detour_.ask(input(), {9.0, 2.0}, door);
  deliver();
  EXPECT_FALSE(detour_.due(now_, in(10.0), Eigen::Vector2d(4.2, 2.2))) << "the same, which sways";
  EXPECT_TRUE(detour_.due(now_, in(10.0), Eigen::Vector2d(8.0, 2.0))) << "in another door, out of sight";
}

TEST_F(DetourTest, SwitchesToAPathToTheGoalWithoutStopping) {
  begin();
  run(0.5);
  detour_.breakOff();
  EXPECT_FALSE(detour_.active());
  EXPECT_TRUE(controller_.follower().followsPath());
  flight_.offer(straight(position_m(), {6.0, 2.0}), now_, state_);
  EXPECT_EQ(flight_.plan()->points_map_m.back(), Eigen::Vector2d(6.0, 2.0));
}

}  // namespace
}  // namespace swiftlet::autonomy
