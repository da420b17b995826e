// Land over a landing pattern that is seen from moment to moment.
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

/// It took off at (1.5, 2.0).
class PatternDescentInFlight : public ManeuverInFlight {
 protected:
  void show(double x_m, double y_m, bool confirmed = true, double lean_rad = 0.0) {
    auto layer = std::make_shared<common::ObjectsLayer>();
    common::RecognizedObject door, pattern;
    door.id = 3;
    door.what = "door";
    door.passage = common::Passage::kOpen;
    door.confirmed = true;
    door.T_map_object.position_m = {1.5, 2.0, 1.0};
    pattern.id = 7;
    pattern.what = "H";
    pattern.confirmed = confirmed;
    pattern.T_map_object = {common::quaternionFrom({lean_rad, 0.0, 0.7}), {x_m, y_m, 0.0}};
    layer->objects = {door, pattern};
    objects_ = layer;
  }
  double height_m() const { return state_.T_odom_body.position_m.z(); }
};

TEST_F(PatternDescentInFlight, FliesOverTheMiddleDescendsAndSaysHowFarOffItStands) {
  show(1.8, 1.7);
  want(common::LandIntent{});
  runUntil([this] { return height_m() < 0.95; }, 10.0);
  EXPECT_LT(distanceTo_m({1.8, 1.7}), 0.1) << "it is over the middle before it descends";
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(controller_.state(), FlightState::kLanded);
  EXPECT_LT(distanceTo_m({1.8, 1.7}), 0.03);
  EXPECT_THAT(executor_.status().reason, testing::MatchesRegex("on the ground, 0.0[0-3] m off the middle of `H`"));
}

TEST_F(PatternDescentInFlight, FollowsAPlaceThatIsSeenBetterFromNear) {
  show(1.7, 2.1);
  want(common::LandIntent{});
  runUntil([this] { return height_m() < 0.9; }, 10.0);
  show(1.8, 2.15);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({1.8, 2.15}), 0.05);
}

TEST_F(PatternDescentInFlight, FliesBackOverTheMiddleBeforeItDescendsOn) {
  show(1.5, 2.0);
  want(common::LandIntent{});
  runUntil([this] { return height_m() < 0.85; }, 10.0);
  show(1.9, 2.0);
  run(0.3);
  const double begun_m = height_m();
  runUntil([this] { return distanceTo_m({1.9, 2.0}) < 0.1; }, 10.0);
  EXPECT_GT(height_m(), begun_m - 0.1);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({1.9, 2.0}), 0.05);
}

TEST_F(PatternDescentInFlight, LandsOnThePlaceThatWasKnownWhenThePatternIsLost) {
  show(1.8, 1.8);
  want(common::LandIntent{});
  run(1.0);
  objects_ = std::make_shared<common::ObjectsLayer>();
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({1.8, 1.8}), 0.05);
}

TEST_F(PatternDescentInFlight, WhatIsNoPatternBelowIsNotLandedOn) {
  struct Shown {
    double x_m;
    bool confirmed;
    double lean_rad;
  };
  for (const Shown& shown : {Shown{2.3, true, 0.0}, Shown{1.8, false, 0.0}, Shown{1.8, true, 0.5}}) {
    show(shown.x_m, 2.0, shown.confirmed, shown.lean_rad);
    want(common::LandIntent{});
    ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
    EXPECT_EQ(executor_.status().reason, "on the ground") << "far away, not confirmed, or leaning";
    EXPECT_LT(distanceTo_m({1.5, 2.0}), 0.1);
    want(common::TakeOffIntent{kHeight_m});
    ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  }
}

TEST_F(PatternDescentInFlight, KeptOffItLandsWhereItIs) {
  show(1.9, 2.0);
  follows_ = false;
  want(common::LandIntent{});
  run(39.0);
  EXPECT_EQ(controller_.state(), FlightState::kFlying);
  EXPECT_EQ(executor_.status().reason, "landing on `H`, 0.40 m off its middle");
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(reasonOf("landing where it is"), "it was kept off the middle of `H`");
  EXPECT_EQ(executor_.status().reason, "on the ground, 0.40 m off the middle of `H`");
}

TEST_F(PatternDescentInFlight, ARetreatEndsInALandingWhereItIs) {
  show(1.9, 2.0);
  want(common::LandIntent{});
  run(1.0);
  retreat({-0.5, 0.0});
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  EXPECT_EQ(timesSaid("landing where it is"), 1);
}

}  // namespace
}  // namespace swiftlet::autonomy
