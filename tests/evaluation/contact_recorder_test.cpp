// The first contact that a flight did not mean, told tick by tick.
#include "evaluation/contact_recorder.hpp"

#include <gmock/gmock.h>

#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::FlightState;
using testing::HasSubstr;

class Contacts : public testing::Test {
 protected:
  void see(FlightState flight, common::FlownBy by = common::FlownBy::kMission) {
    test::Layers layers;
    layers.vehicle.flight_state = flight;
    layers.mission.status.flown_by = by;
    recorder_.world(layers.world());
    recorder_.motors(flight != FlightState::kPoweredOff);
  }
  /// Ticks of 0.1 s at that height of the body; it stands at 0.15 m.
  void be(double height_m, int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      truth_.stamp = truth_.stamp + common::Duration::fromMilliseconds(100);
      truth_.T_world_body.position_m = {1, 2, height_m};
      truth_.airborne = height_m > 0.15;
      if (truth_.airborne) truth_.battery_remaining -= 0.001;
      recorder_.tick(truth_);
    }
  }
  void takeOff() {
    be(0.15, 5);
    recorder_.intent({1, common::TakeOffIntent{1.2}});
    see(FlightState::kTakingOff);
    be(0.15, 5);
    be(0.5, 5);
    see(FlightState::kFlying);
    be(1.0, 20);
  }

  ContactRecorder recorder_;
  simulation::Truth truth_;
};

TEST_F(Contacts, AFlightThatLandsHasNone) {
  takeOff();
  see(FlightState::kLanding);
  be(0.5, 5);
  be(0.15, 5);
  see(FlightState::kLanded);
  be(0.15, 5);
  EXPECT_FALSE(recorder_.motorsOff()) << "they idle";
  see(FlightState::kPoweredOff);
  be(0.15, 5);
  EXPECT_TRUE(recorder_.motorsOff());
  EXPECT_FALSE(recorder_.finish());
}

TEST_F(Contacts, AVehicleThatSinksToTheFloorHasOneWhateverItDoesThen) {
  truth_.faulty = true;
  takeOff();
  be(0.15, 10);
  see(FlightState::kEmergencyLanding);
  be(0.15, 10);
  see(FlightState::kPoweredOff);
  be(0.15, 50);
  const auto contact = recorder_.finish();
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->flight, FlightState::kFlying);
  EXPECT_NEAR(contact->floor_s, 1.9, 1e-9) << "until the motors are off";
  EXPECT_EQ(contact->what,
            "stood on the floor at (1.00, 2.00, 0.15) for 1.9 s with its motors on, where it meant to fly");
}

TEST_F(Contacts, AVehicleThatRisesFromTheFloorAgainHasOneToo) {
  takeOff();
  be(0.15, 6);
  be(1.0, 20);
  be(0.15, 6);
  ASSERT_TRUE(recorder_.finish());
  EXPECT_NEAR(recorder_.finish()->floor_s, 1.0, 1e-9) << "both times together";
  EXPECT_NEAR(recorder_.finish()->truth.stamp.seconds(), 3.6, 1e-9) << "the first time";
}

TEST_F(Contacts, ATakeOffThatSinksBackHasOne) {
  be(0.15, 5);
  see(FlightState::kTakingOff);
  be(0.16, 2);
  be(0.15, 2);
  EXPECT_FALSE(recorder_.finish()) << "it has not left the floor yet";
  be(0.5, 5);
  be(0.15, 2);
  ASSERT_TRUE(recorder_.finish());
  EXPECT_EQ(recorder_.finish()->flight, FlightState::kTakingOff);
}

TEST_F(Contacts, APilotMayStandWhereverTheSticksSay) {
  takeOff();
  see(FlightState::kFlying, common::FlownBy::kPilot);
  be(0.15, 50);
  EXPECT_FALSE(recorder_.finish());
}

TEST_F(Contacts, OfTheHullAreAlwaysOnes) {
  takeOff();
  be(1.0, 200);
  see(FlightState::kLanding);
  truth_.crashed = true;
  truth_.crash_reason = "touched `table`";
  be(0.9);
  const auto contact = recorder_.finish();
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->what, "touched `table`");
  EXPECT_EQ(contact->flight, FlightState::kLanding);
  EXPECT_EQ(contact->floor_s, 0.0);
  EXPECT_EQ(contact->take_off_height_m, 1.2);
  EXPECT_NEAR(contact->stood_world_m.z(), 0.15, 1e-9);
  EXPECT_NEAR(contact->charge_before - contact->truth.battery_remaining, 0.1, 0.0015) << "ten seconds before";
}

}  // namespace
}  // namespace swiftlet::evaluation
