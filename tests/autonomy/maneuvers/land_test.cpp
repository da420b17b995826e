// Land, from the air to the ground, with interruptions.
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
