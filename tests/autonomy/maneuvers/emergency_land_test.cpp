// EmergencyLand: the controller's descent without the estimate, from where the vehicle is to the ground.
#include <memory>

#include <gtest/gtest.h>

#include "autonomy/maneuvers/table.hpp"
#include "tests/autonomy/maneuvers/workbench.hpp"

namespace swiftlet::autonomy {
namespace {

class EmergencyLandManeuver : public ManeuverWorkbench {
 protected:
  std::unique_ptr<Maneuver> land_ = makeManeuver(common::EmergencyLandIntent{}, setup_);
};

TEST_F(EmergencyLandManeuver, CommandsTheDescentFromFlight) {
  ASSERT_EQ(controller_.state(), FlightState::kFlying);
  const Progress progress = land_->step(input());
  EXPECT_EQ(progress.state, IntentState::kRunning);
  EXPECT_EQ(progress.reason, "descending");
  EXPECT_EQ(controller_.state(), FlightState::kEmergencyLanding);
}

TEST_F(EmergencyLandManeuver, GoesOnWhileTheControllerDescends) {
  (void)land_->step(input());
  const Progress progress = land_->step(input());
  EXPECT_EQ(progress.state, IntentState::kRunning);
  EXPECT_EQ(progress.reason, "descending");
  EXPECT_EQ(controller_.state(), FlightState::kEmergencyLanding);
}

TEST_F(EmergencyLandManeuver, JoinsADescentThatTheControllerBeganByItself) {
  ASSERT_TRUE(controller_.command(control::EmergencyLand{}));
  EXPECT_EQ(land_->step(input()).state, IntentState::kRunning);
  EXPECT_EQ(controller_.state(), FlightState::kEmergencyLanding);
}

TEST_F(EmergencyLandManeuver, EndsOnTheGroundWithTheMotorsOff) {
  want(common::EmergencyLandIntent{});
  run(0.2);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_EQ(controller_.state(), FlightState::kEmergencyLanding);
  state_.T_odom_body.position_m.z() = kStanding_m;  // It has come down.
  EXPECT_EQ(runToTheEnd(30.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "on the ground");
  EXPECT_EQ(controller_.state(), FlightState::kPoweredOff);
}

using EmergencyLandOnTheGround = ManeuverStory;

TEST_F(EmergencyLandOnTheGround, IsDoneAtOnceAndCommandsNothing) {
  const FlightState before = controller_.state();
  want(common::EmergencyLandIntent{});
  EXPECT_EQ(runToTheEnd(0.5), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "on the ground");
  EXPECT_EQ(controller_.state(), before);
}

}  // namespace
}  // namespace swiftlet::autonomy
