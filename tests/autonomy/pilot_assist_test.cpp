// What a pilot's sticks wish, and when the program assists.
#include "autonomy/pilot_assist.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::FlightState;

common::VehicleState knownAt(double yaw_rad) {
  common::VehicleState state;
  state.T_odom_body.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  state.horizontal_valid = state.vertical_valid = true;
  return state;
}

/// Sticks that wish these shares of the speed.
common::PilotSample sticks(double pitch, double roll, bool takes_over = true) {
  const auto beyond = [](double wish) {
    return wish == 0.0 ? 0.0 : std::copysign(PilotAssist::kDeadBand, wish) + (1.0 - PilotAssist::kDeadBand) * wish;
  };
  return {{}, beyond(roll), beyond(pitch), 0.0, 0.5, takes_over};
}

PilotAssist assistant(bool enabled = true) {
  PilotAssistConfig config;
  config.enabled = enabled;
  config.speed_m_s = 2.0;
  return {config, 20.0, {}};
}

TEST(PilotAssist, SticksAreAVelocityInTheBodyFrame) {
  PilotAssist assist = assistant();
  assist.pilotArrived(sticks(0.5, 0.25));
  ASSERT_TRUE(assist.assists(true, FlightState::kFlying, knownAt(0.0)));
  EXPECT_TRUE(assist.wantedVelocity_map_m_s(knownAt(0.0)).isApprox(Eigen::Vector2d(1.0, -0.5)));
  const double left_rad = 0.5 * std::numbers::pi;
  EXPECT_TRUE(assist.wantedVelocity_map_m_s(knownAt(left_rad)).isApprox(Eigen::Vector2d(0.5, 1.0), 1e-9));
}

TEST(PilotAssist, AssistsOnlyAPilotWhoFliesWhileThePositionIsKnown) {
  PilotAssist assist = assistant();
  assist.pilotArrived(sticks(0.5, 0.0, false));
  EXPECT_FALSE(assist.assists(false, FlightState::kFlying, knownAt(0.0)));
  assist.pilotArrived(sticks(0.5, 0.0));
  EXPECT_FALSE(assist.assists(true, FlightState::kLanded, knownAt(0.0)));
  EXPECT_TRUE(assist.assists(true, FlightState::kFlying, knownAt(0.0)));
  common::VehicleState lost = knownAt(0.0);
  lost.horizontal_valid = false;
  EXPECT_FALSE(assist.assists(true, FlightState::kFlying, lost));
  EXPECT_TRUE(assist.wantedVelocity_map_m_s(lost).isZero()) << "the reactive layer brakes for the vehicle's own motion";
  PilotAssist disabled = assistant(false);
  disabled.pilotArrived(sticks(0.5, 0.0));
  EXPECT_FALSE(disabled.assists(true, FlightState::kFlying, knownAt(0.0)));
}

TEST(PilotAssist, AStickThatIsNoNumberIsCentred) {
  PilotAssist assist = assistant();
  assist.pilotArrived(sticks(std::numeric_limits<double>::quiet_NaN(), 5.0));
  ASSERT_TRUE(assist.assists(true, FlightState::kFlying, knownAt(0.0)));
  EXPECT_TRUE(assist.wantedVelocity_map_m_s(knownAt(0.0)).isApprox(Eigen::Vector2d(0.0, -2.0)));
}

TEST(PilotAssist, NothingIsLearnedOfAThrustThatThePilotOverrules) {
  PilotAssist assist = assistant();
  assist.pilotArrived(sticks(0.0, 0.0));
  EXPECT_TRUE(assist.thrustApplies(0.65));
  EXPECT_FALSE(assist.thrustApplies(0.75));
}

}  // namespace
}  // namespace swiftlet::autonomy
