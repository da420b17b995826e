// A pilot takes over in any phase of the flight: what the program does meanwhile has no effect, and goes on from where
// the pilot gives the vehicle back.
#include <gtest/gtest.h>

#include "control/flight_controller.hpp"
#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

TEST(PilotFlight, ALandingGoesOnWhereThePilotGivesTheVehicleBack) {
  Flight flight;
  flight.hover(1.0);
  flight.pilot_climbs_m_s = 0.0;
  flight.run(0.5);
  ASSERT_TRUE(flight.controller.command(Land{}));
  flight.pilot_climbs_m_s = 0.3;
  flight.run(3.0);
  const double given_back_at_m = flight.model.position_m.z();
  ASSERT_GT(given_back_at_m, 1.6);
  EXPECT_EQ(flight.controller.state(), FlightState::kLanding);
  flight.pilot_climbs_m_s.reset();
  flight.run(0.6);
  EXPECT_NEAR(flight.model.position_m.z(), given_back_at_m, 0.2) << "it flies back to where the landing began";
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 12.0));
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.35);
}

TEST(PilotFlight, APilotWhoHoversLowHasNotLanded) {
  Flight flight;
  flight.hover(0.6);
  flight.pilot_climbs_m_s = -0.3;
  ASSERT_TRUE(flight.until([&] { return flight.model.position_m.z() < 0.25; }, 4.0));
  flight.pilot_climbs_m_s = 0.0;
  ASSERT_TRUE(flight.controller.command(Land{}));
  flight.run(5.0);
  EXPECT_EQ(flight.controller.state(), FlightState::kLanding) << "the motors would be switched off in the air";
  flight.pilot_climbs_m_s.reset();
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 6.0));
}

TEST(PilotFlight, AnEmergencyLandingGoesOnFromThePilotsHeight) {
  Flight flight;
  flight.hover(1.0);
  flight.pilot_climbs_m_s = 0.0;
  ASSERT_TRUE(flight.controller.command(EmergencyLand{}));
  flight.run(30.0);
  EXPECT_EQ(flight.controller.state(), FlightState::kEmergencyLanding);
  flight.pilot_climbs_m_s.reset();
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 10.0));
  EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.7);
}

TEST(PilotFlight, ATakeOffIsFinishedFromWhereThePilotHoldsIt) {
  Flight flight;
  flight.tick();
  ASSERT_TRUE(flight.controller.command(Prepared{}));
  ASSERT_TRUE(flight.controller.command(TakeOff{1.0}));
  ASSERT_TRUE(flight.until([&] { return flight.model.position_m.z() > 0.5; }, 6.0));
  flight.pilot_climbs_m_s = 0.0;
  flight.run(40.0);
  EXPECT_EQ(flight.controller.state(), FlightState::kTakingOff) << "a time limit ran while the pilot flew";
  flight.pilot_climbs_m_s.reset();
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kFlying; }, 8.0));
  EXPECT_NEAR(flight.model.position_m.z(), 1.0, 0.15);
}

}  // namespace
}  // namespace swiftlet::control
