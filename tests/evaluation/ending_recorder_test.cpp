// What is kept of the end of a flight, told tick by tick.
#include "evaluation/ending_recorder.hpp"

#include <gtest/gtest.h>

#include "simulation/sensors/sensor_config.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::FlightState;
using common::MissionState;

class Ending : public testing::Test {
 protected:
  /// Ticks of 0.5 s, in each of which a hundredth of the battery goes.
  void tick(int count = 1) {
    for (int i = 0; i < count; ++i) {
      truth_.stamp = truth_.stamp + common::Duration::fromMilliseconds(500);
      if (truth_.airborne) truth_.battery_remaining -= 0.01;
      recorder_.tick(truth_, error_m_);
    }
  }
  void see(MissionState mission, FlightState flight = FlightState::kFlying) {
    test::Layers layers;
    layers.mission.status.state = mission;
    layers.vehicle.flight_state = flight;
    recorder_.world(layers.world());
  }
  void takeOff() {
    tick(2);
    truth_.airborne = true;
    see(MissionState::kRunning);
  }
  void land() {
    see(MissionState::kFailed, FlightState::kLanding);
    tick(30);
    truth_.airborne = false;
    tick();
  }

  EndingRecorder recorder_;
  simulation::Truth truth_;
  double error_m_ = 0.1;
};

TEST_F(Ending, IsJudgedAtTheLastTickInTheMission) {
  takeOff();
  tick(10);
  truth_.T_world_body.position_m = {3, 0, 1};
  tick(10);
  error_m_ = 0.7;
  land();
  const EndingRecord record = recorder_.finish();
  EXPECT_TRUE(record.flew);
  EXPECT_NEAR(record.then.battery_remaining, 0.8, 1e-9);
  EXPECT_NEAR(record.charge_at_take_off, 0.99, 1e-9);
  EXPECT_NEAR(record.airborne_until_then_s, 9.5, 1e-9);
  EXPECT_NEAR(record.position_error_m, 0.1, 1e-9) << "what grows on the way down is no reason to land";
  EXPECT_EQ(record.trail_world_m.size(), 20u);
}

TEST_F(Ending, OfAVehicleThatNeverFliesIsItsLastTick) {
  tick(10);
  truth_.battery_remaining = 0.2;
  tick();
  EXPECT_FALSE(recorder_.finish().flew);
  EXPECT_EQ(recorder_.finish().then.battery_remaining, 0.2);
}

TEST_F(Ending, AFaultCountsOnlyAroundTheDecision) {
  takeOff();
  tick(5);
  truth_.failed_sensor = simulation::Sensor::kLaser;
  tick();
  truth_.failed_sensor.reset();
  EndingRecorder soon = recorder_;
  tick(20);
  land();
  EXPECT_EQ(recorder_.finish().faulty_sensor, "") << "it flew on for 10 s";
  recorder_ = soon;
  land();
  EXPECT_EQ(recorder_.finish().faulty_sensor, "laser");
}

TEST_F(Ending, AFaultDuringTheLandingIsNoReasonForIt) {
  takeOff();
  tick(5);
  see(MissionState::kFailed, FlightState::kLanding);
  tick(12);
  truth_.failed_sensor = simulation::Sensor::kImu;
  tick();
  EXPECT_EQ(recorder_.finish().faulty_sensor, "");
}

TEST_F(Ending, AnOrderCountsUntilTheMissionHasRunOn) {
  takeOff();
  tick(5);
  recorder_.order(truth_.stamp, "land");
  EndingRecorder soon = recorder_;
  land();
  EXPECT_EQ(recorder_.finish().order, "land");
  recorder_ = soon;
  truth_.airborne = true;
  tick(20);
  land();
  EXPECT_EQ(recorder_.finish().order, "");
}

TEST_F(Ending, KeepsTheGoalThatFailedLast) {
  const auto goTo = [&](std::uint64_t id, common::IntentState state) {
    common::GoToIntent go_to;
    go_to.goal_map_m = {1.0 * static_cast<double>(id), 0.0};
    recorder_.intent({id, go_to}, {id, state, "", true});
  };
  goTo(1, common::IntentState::kFailed);
  ASSERT_TRUE(recorder_.finish().failed_goal_map_m);
  EXPECT_EQ(recorder_.finish().failed_goal_map_m->x(), 1.0);
  goTo(2, common::IntentState::kSucceeded);
  EXPECT_FALSE(recorder_.finish().failed_goal_map_m) << "the mission went on";
}

}  // namespace
}  // namespace swiftlet::evaluation
