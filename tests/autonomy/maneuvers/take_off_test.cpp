// TakeOff: reaches its height, or says why not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::HasSubstr;

using TakeOffManeuver = ManeuverStory;

TEST_F(TakeOffManeuver, SucceedsAtTheHeight) {
  ceiling_m_ = 0.8;
  want(common::TakeOffIntent{kHeight_m});
  run(6.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  ceiling_m_ = kHeight_m;
  EXPECT_EQ(runToTheEnd(2.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "at the take-off height");
}

TEST_F(TakeOffManeuver, FailsWhenItIsRefusedOrAborted) {
  want(common::TakeOffIntent{0.1});
  ASSERT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, HasSubstr("is not above"));
  ceiling_m_ = 0.5;  // The controller gives up in the end and lands.
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(30.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot take off: landing because not hovering after 17 s");
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed) << "it still comes down";
  EXPECT_EQ(executor_.status().reason, "cannot take off: landing because not hovering after 17 s");
}

TEST_F(TakeOffManeuver, WaitsALittleForSensorsThatSeeWhereItIs) {
  unready_ = "no beams return";
  want(common::TakeOffIntent{kHeight_m});
  run(3.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_EQ(executor_.status().reason, "take-off delayed: no beams return");
  EXPECT_EQ(controller_.state(), FlightState::kPoweredOff) << "its motors are off";
  unready_.clear();
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  unready_ = "no beams return";
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kSucceeded) << "in flight it takes off no more";
}

TEST_F(TakeOffManeuver, IsRefusedWhereTheSensorsGoOnSeeingTooLittle) {
  unready_ = "no beams return";
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(6.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "take-off refused: no beams return");
  EXPECT_EQ(controller_.state(), FlightState::kPoweredOff);
  EXPECT_EQ(timesSaid("take-off delayed"), 1);
}

TEST_F(TakeOffManeuver, SucceedsAtOnceInFlightAndGivesTheHeightOfTheNextPath) {
  want(common::TakeOffIntent{kHeight_m});
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  want(common::TakeOffIntent{1.4});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kSucceeded);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), kHeight_m, 0.05);
  want(to(2.0, 2.0));
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), 1.4, 0.05);
}

/// Of a mission that took the place of one that may fly higher.
TEST_F(TakeOffManeuver, PathsEndAtTheGreatestHeightIfTheyWereHigher) {
  want(common::TakeOffIntent{kHeight_m});
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  controller_.setMaxHeight(0.7);
  want(to(2.0, 2.0));
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), 0.7, 0.05);
}

TEST_F(TakeOffManeuver, ContinuesWhenItIsRequestedAgainDuringTheClimb) {
  want(common::TakeOffIntent{kHeight_m});
  run(2.0);
  ASSERT_EQ(controller_.state(), FlightState::kTakingOff);
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
}

}  // namespace
}  // namespace swiftlet::autonomy
