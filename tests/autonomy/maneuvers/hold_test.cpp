// Hold: stops and stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using HoldManeuver = ManeuverInFlight;

TEST_F(HoldManeuver, StopsThePresentPathAndReleasesTheVehicleAtRest) {
  want(to(6.0, 2.0));
  runUntil([this] { return position_m().x() > 2.5; }, 10.0);
  want(common::HoldIntent{});
  run(0.05);
  EXPECT_FALSE(controller_.follower().followsPath());
  EXPECT_FALSE(executor_.status().released) << "it still moves";
  EXPECT_EQ(executor_.aim().velocity_map_m_s, Eigen::Vector2d::Zero());
  run(2.0);
  EXPECT_TRUE(executor_.status().released);
  const Eigen::Vector2d here_m = position_m();
  run(5.0);
  EXPECT_LT(distanceTo_m(here_m), 0.01);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning) << "it ends when another intent comes";
  EXPECT_EQ(executor_.status().reason, "holding");
}

}  // namespace
}  // namespace swiftlet::autonomy
