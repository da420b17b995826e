// How a vehicle was flown: from truth and snapshots to figures, tick by tick.
#include <cmath>

#include <gmock/gmock.h>

#include "evaluation/conduct_recorder.hpp"
#include "evaluation/flight_scoring.hpp"
#include "small_world.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::FlightState;
using common::IntentState;
using common::MissionState;
using common::Time;
using testing::ElementsAre;

/// A flight that a test tells, with a tick each 0.1 s.
class Conduct : public testing::Test {
 protected:
  void tick(double seconds = 0.1) {
    for (int i = 0, ticks = static_cast<int>(std::lround(seconds / 0.1)); i < ticks; ++i) {
      recorder_.tick(truth_);
      truth_.stamp = truth_.stamp + common::Duration::fromMilliseconds(100);
    }
  }
  void tilt(double deg) { truth_.T_world_body.rotation = common::quaternionFrom({0.0, deg * common::kRadPerDeg, 1.0}); }
  void snapshot(FlightState flight, MissionState mission = MissionState::kRunning) {
    test::Layers layers;
    layers.vehicle.flight_state = flight;
    layers.mission.status.state = mission;
    layers.energy.home_share = home_share_;
    recorder_.world(layers.world());
  }
  void goHome(std::uint64_t id, IntentState state) {
    recorder_.intent({id, common::GoToIntent{}}, {id, state, "", true}, true);
  }
  ConductRecord record() const { return recorder_.finish(); }

  ConductRecorder recorder_;
  simulation::Truth truth_;
  std::optional<double> home_share_;
};

TEST_F(Conduct, OnTheGroundNothingIsMeasured) {
  tilt(30);
  tick(5.0);
  EXPECT_EQ(record().airborne_s, 0.0);
  EXPECT_EQ(record().tilted_s, 0.0);
  EXPECT_FALSE(record().touch_down_speed_m_s || record().charge_min || record().safe_action_s || record().home_energy);
}

TEST_F(Conduct, TimeAbove10DegreesCountsWhateverTheHeading) {
  truth_.airborne = true;
  tick(0.1);
  tick(8.0);
  tilt(10.5);
  tick(1.5);
  tilt(-12.0);
  tick(0.5);
  EXPECT_NEAR(record().airborne_s, 10.0, 1e-9);
  EXPECT_NEAR(record().tilted_s, 2.0, 1e-9);
  EXPECT_NEAR(record().tilt_max_rad, 12.0 * common::kRadPerDeg, 1e-9);
}

TEST_F(Conduct, TheHardestTouchDownCountsByItsSpeedBefore) {
  const auto land = [&](double down_m_s) {
    truth_.airborne = true;
    truth_.velocity_world_m_s = {0.3, 0.0, -down_m_s};
    tick();
    truth_.airborne = false;
    truth_.velocity_world_m_s.setZero();
    tick();
  };
  land(0.1);
  land(0.35);
  land(0.2);
  EXPECT_NEAR(record().touch_down_speed_m_s.value(), 0.35, 1e-9);
}

TEST_F(Conduct, ACrashIsNoTouchDown) {
  truth_.airborne = true;
  tick();
  truth_.airborne = false;
  truth_.crashed = true;
  tick();
  EXPECT_FALSE(record().touch_down_speed_m_s);
}

TEST_F(Conduct, AFaultIsAnsweredByTheFirstSnapshotThatHoldsOrLands) {
  truth_.airborne = true;
  tick(5.0);
  truth_.faulty = true;
  snapshot(FlightState::kFlying);
  tick(0.3);
  snapshot(FlightState::kFlying, MissionState::kHeld);
  tick(1.0);
  snapshot(FlightState::kEmergencyLanding, MissionState::kHeld);
  tick(1.0);
  EXPECT_NEAR(record().safe_action_s.value(), 0.3, 1e-9);
}

TEST_F(Conduct, TheLongestAnswerCounts) {
  truth_.airborne = true;
  for (const double answer_s : {0.2, 0.6, 0.4}) {
    truth_.faulty = false;
    snapshot(FlightState::kFlying);
    tick(1.0);
    truth_.faulty = true;
    tick(answer_s);
    snapshot(FlightState::kLanding);
    tick(0.1);
  }
  EXPECT_NEAR(record().safe_action_s.value(), 0.6, 1e-9);
}

TEST_F(Conduct, AFaultThatIsNeverAnsweredTakesForEver) {
  truth_.airborne = truth_.faulty = true;
  snapshot(FlightState::kFlying);
  tick(3.0);
  EXPECT_TRUE(std::isinf(record().safe_action_s.value()));
  truth_.crashed = true;
  truth_.airborne = false;
  tick(1.0);
  EXPECT_TRUE(std::isinf(record().safe_action_s.value())) << "a wreck on the floor is not safe";
}

TEST_F(Conduct, AVehicleThatStandsIsSafe) {
  truth_.faulty = true;
  snapshot(FlightState::kPoweredOff);
  tick(3.0);
  EXPECT_EQ(record().safe_action_s, 0.0);
}

TEST_F(Conduct, TheEnergyForTheFlightHomeIsThatUntilItStands) {
  truth_.airborne = true;
  truth_.battery_remaining = 0.60;
  home_share_ = 0.05;
  snapshot(FlightState::kFlying);
  tick(1.0);
  goHome(9, IntentState::kRunning);
  home_share_ = 0.02;  // What is predicted later does not count.
  snapshot(FlightState::kFlying);
  truth_.battery_remaining = 0.57;
  tick(1.0);
  goHome(9, IntentState::kSucceeded);
  truth_.battery_remaining = 0.56;
  tick(1.0);
  truth_.airborne = false;
  tick(1.0);
  const ConductRecord::HomeEnergy energy = record().home_energy.value();
  EXPECT_NEAR(energy.predicted, 0.05, 1e-9);
  EXPECT_NEAR(energy.needed, 0.04, 1e-9);
  EXPECT_NEAR(record().charge_min.value(), 0.56, 1e-9);
}

TEST_F(Conduct, AFlightThatDoesNotArriveHomeHasNoEnergyForIt) {
  truth_.airborne = true;
  home_share_ = 0.05;
  snapshot(FlightState::kFlying);
  tick(1.0);
  goHome(9, IntentState::kRunning);
  goHome(9, IntentState::kFailed);
  tick(1.0);
  truth_.airborne = false;
  tick(1.0);
  EXPECT_FALSE(record().home_energy);
}

TEST_F(Conduct, TheLatencyOfScansIsByTheirStamps) {
  recorder_.scan({Time::fromSeconds(1.0), Time::fromSeconds(1.025)});
  recorder_.scan({Time::fromSeconds(2.0), Time::fromSeconds(2.035)});
  const FlightRecord flight = [&] {
    FlightRecord made;
    made.conduct = record();
    return made;
  }();
  const FlightScore score = scoreOf(flight, {}, {}, 1, 0.0);
  EXPECT_NEAR(score.figure("laser_latency_median_s").value(), 0.030, 1e-9);
  EXPECT_NEAR(score.figure("laser_latency_p95_s").value(), 0.0345, 1e-9);
}

/// 1.6 kg and 28 N at a full battery.
TEST_F(Conduct, TheThrustMarginIsThatOfTheLeastCharge) {
  FlightRecord flight;
  flight.conduct.charge_min = 0.4;
  const double tired = scoreOf(flight, {}, {}, 1, 0.0).figure("thrust_margin_min").value();
  flight.conduct.charge_min = 1.0;
  const double full = scoreOf(flight, {}, {}, 1, 0.0).figure("thrust_margin_min").value();
  EXPECT_LT(full, 0.95 * 28.0 / (1.6 * 9.81));
  EXPECT_GT(full, 1.4);
  EXPECT_LT(tired, 0.95 * full);
}

TEST_F(Conduct, EachCriterionFailsWhatMissesItAndWhatLacksItsFigure) {
  Criteria criteria;
  criteria.mission_done = false;
  criteria["tilted_share_max"] = 0.01;
  criteria["thrust_margin_min"] = 1.08;
  criteria["touch_down_speed_max_m_s"] = 0.5;
  criteria["safe_action_max_s"] = 0.5;
  criteria["home_energy_error_max"] = 0.1;
  FlightScore score;
  EXPECT_EQ(missed(score, criteria).size(), 5u);
  score["tilted_share"] = 0.02;
  score["thrust_margin_min"] = 1.02;
  score["touch_down_speed_m_s"] = 0.8;
  score["safe_action_s"] = INFINITY;
  score["home_energy_error"] = 0.25;
  EXPECT_THAT(missed(score, criteria),
              ElementsAre("share of the time tilted: 0.020, at most 0.01 was asked for",
                          "thrust margin: 1.0200, at least 1.08 was asked for",
                          "touch-down speed, m/s: 0.800, at most 0.5 was asked for",
                          "time from fault to safe action, s: inf, at most 0.5 was asked for",
                          "error of the energy for the flight home: 0.250, at most 0.1 was asked for"));
  score["tilted_share"] = 0.005;
  score["thrust_margin_min"] = 1.2;
  score["touch_down_speed_m_s"] = 0.3;
  score["safe_action_s"] = 0.4;
  score["home_energy_error"] = 0.05;
  EXPECT_THAT(missed(score, criteria), testing::IsEmpty());
}

}  // namespace
}  // namespace swiftlet::evaluation
