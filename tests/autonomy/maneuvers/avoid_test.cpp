// Avoid: the reactive layer controls the vehicle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using AvoidManeuver = ManeuverInFlight;

TEST_F(AvoidManeuver, ReportsItsReasonAndReleasesTheVehicleAfterTheRetreat) {
  retreat({-0.5, 0.0});
  want(common::AvoidIntent{});
  run(1.5);
  EXPECT_EQ(executor_.status().reason, "a person approaches");
  retreat(Eigen::Vector2d::Zero());
  run(1.5);
  EXPECT_FALSE(executor_.status().released) << "it stands, but the layer still controls it";
  calm();
  run(1.5);
  EXPECT_TRUE(executor_.status().released) << "it has stopped";
  want(to(1.5, 3.4));
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
}

}  // namespace
}  // namespace swiftlet::autonomy
