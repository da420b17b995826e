// Land, from the air to the ground, with interruptions.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using LandManeuver = ManeuverInFlight;

TEST_F(LandManeuver, SucceedsEveryTimeOnTheGround) {
  want(common::LandIntent{});
  run(0.5);
  want(common::LandIntent{});
  run(0.5);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_EQ(controller_.state(), FlightState::kLanding);
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  EXPECT_EQ(controller_.state(), FlightState::kLanded);
  EXPECT_EQ(executor_.status().reason, "on the ground");
  want(common::LandIntent{});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kSucceeded);
}

/// A floor that was seen along a strip through the room, up to the edge of a platform.
std::shared_ptr<const common::LevelMap> edgeAt(double x_m) {
  auto levels = std::make_shared<common::LevelMap>();
  levels->levels = {{0, 0.0, 1e-4, {}}, {1, 0.2, 1e-4, {}}};
  for (int x = 2; x < 26; ++x)
    for (int y = 18; y < 22; ++y) levels->levels[x < std::lround(10.0 * x_m) ? 0 : 1].cells.push_back({x, y});
  return levels;
}

TEST_F(LandManeuver, FliesAwayFromAnEdgeBeforeItDescends) {
  want(to(2.05, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  surfaces_ = edgeAt(2.0);
  want(common::LandIntent{});
  ASSERT_EQ(runToTheEnd(25.0), IntentState::kSucceeded);
  EXPECT_LT(position_m().x(), 2.0 - 0.275) << "the hull is off the edge";
  EXPECT_GT(position_m().x(), 1.2);
  EXPECT_EQ(timesSaid("landing at"), 1);
  EXPECT_EQ(timesSaid("landing where it is"), 0);
}

/// The beams that look down have seen the floor along the trail, up to the goal.
TEST_F(LandManeuver, LooksBeyondTheEndOfTheTrailAndLandsAtTheGoal) {
  want(to(3.0, 2.0));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  const auto trail = [](int end) {
    auto levels = std::make_shared<common::LevelMap>();
    levels->levels = {{0, 0.0, 1e-4, {}}};
    for (int x = 15; x < end; ++x)
      for (int y = 18; y < 22; ++y) levels->levels[0].cells.push_back({x, y});
    return levels;
  };
  surfaces_ = trail(31);
  want(common::LandIntent{});
  double farthest_m = 0.0;
  for (int i = 0; i < 250 && controller_.state() == FlightState::kFlying; ++i) {
    run(0.1);
    farthest_m = std::max(farthest_m, position_m().x());
    surfaces_ = trail(static_cast<int>(10.0 * farthest_m) + 1);
  }
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  EXPECT_GT(farthest_m, 3.4);
  EXPECT_LT(distanceTo_m({3.0, 2.0}), 0.1);
  EXPECT_EQ(timesSaid("landing at"), 0);
}

/// What it stood on carries it, also if beams that look down say that it is not level: it took off at x = 1.5 m.
TEST_F(LandManeuver, LandsWhereItTookOffAlsoOnAnEdge) {
  want(to(1.7, 2.1));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  surfaces_ = edgeAt(1.6);
  want(common::LandIntent{});
  ASSERT_EQ(runToTheEnd(25.0), IntentState::kSucceeded);
  EXPECT_LT(distanceTo_m({1.5, 2.0}), 0.1);
  EXPECT_EQ(timesSaid("landing at"), 0);
}

/// Somebody walks over the place where it took off while it flies there.
TEST_F(LandManeuver, WaitsForAPathToThePlaceWhereItTookOff) {
  want(to(1.95, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  surfaces_ = edgeAt(2.5);
  follows_ = false;
  want(common::LandIntent{});
  run(2.0);
  discs_ = {{{1.5, 2.0}, 0.2}};
  run(3.0);
  discs_.clear();
  follows_ = true;
  ASSERT_EQ(runToTheEnd(25.0), IntentState::kSucceeded);
  EXPECT_LT(distanceTo_m({1.5, 2.0}), 0.1);
  EXPECT_EQ(timesSaid("landing where it is"), 0);
}

TEST_F(LandManeuver, LandsWhereItIsIfNoLevelPlaceIsKnown) {
  want(to(6.0, 2.0));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  auto levels = std::make_shared<common::LevelMap>();
  levels->levels = {{0, 0.0, 1e-4, {{60, 20}}}, {1, 0.2, 1e-4, {{61, 20}}}};
  surfaces_ = levels;
  want(common::LandIntent{});
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  EXPECT_LT(distanceTo_m({6.0, 2.0}), 0.1);
  EXPECT_EQ(reasonOf("landing where it is"), "no level place for the hull is known within 4 m");
}

TEST_F(LandManeuver, WithoutAPositionItDescendsAtOnce) {
  want(to(2.05, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  surfaces_ = edgeAt(2.0);
  state_.horizontal_valid = false;
  want(common::LandIntent{});
  run(0.2);
  EXPECT_EQ(controller_.state(), FlightState::kLanding);
}

TEST_F(LandManeuver, ALandingAtAPlaceThatIsNotKnownIsNoSuccess) {
  drift_m_ = 0.6;
  want(common::LandIntent{});
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "on the ground, at a place that is uncertain by 0.6 m");
}

TEST_F(LandManeuver, EndsARetreat) {
  retreat({-0.5, 0.0});
  run(0.5);
  want(common::LandIntent{});
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  calm();
  run(0.5);
  EXPECT_TRUE(executor_.status().released);
}

}  // namespace
}  // namespace swiftlet::autonomy
