// The supervisor above the mission, tick by tick.
#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/health/checks.hpp"
#include "tests/autonomy/supervisor_story.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;
using testing::HasSubstr;

TEST_F(SupervisorStory, OperatorHoldsUntilResume) {
  EXPECT_FALSE(at(0.0).hold);
  const auto held = supervisor_.take({1, common::HoldCommand{}}, Time::fromSeconds(0.1));
  ASSERT_TRUE(held && held->accepted);
  EXPECT_TRUE(at(0.1).hold);
  EXPECT_TRUE(at(60.0).hold);
  ASSERT_TRUE(supervisor_.take({2, common::ResumeCommand{}}, Time::fromSeconds(61)));
  EXPECT_FALSE(at(61.0).hold);
}

TEST_F(SupervisorStory, TellsWhatFliesTheVehicle) {
  const auto told = [&](double time_s) {
    const Supervision& now = at(time_s);
    return std::string(toString(now.flown_by)) + ": " + std::string(phaseOf(now));
  };
  EXPECT_EQ(told(0.0), "mission: ");
  ASSERT_TRUE(supervisor_.take({1, common::HoldCommand{}}, Time::fromSeconds(0.1)));
  EXPECT_EQ(told(0.1), "operator: hold");
  ASSERT_TRUE(supervisor_.goHome({2, common::HomeCommand{}}).accepted);
  EXPECT_EQ(told(0.2), "operator: fly home");
  supervisor_.pilotArrived(Time::fromSeconds(0.3), true);
  EXPECT_EQ(told(0.3), "pilot: hold");
  EXPECT_EQ(alarmOf(log_.take().back()), "pilot");
  supervisor_.pilotArrived(Time::fromSeconds(0.4), false);
  ASSERT_TRUE(supervisor_.take({3, common::LandCommand{}}, Time::fromSeconds(0.5)));
  EXPECT_EQ(told(0.5), "operator: land");
  EXPECT_EQ(alarmOf(log_.take().back()), "") << "the operator asked for it";
}

TEST_F(SupervisorStory, TheMissionHoldsWhileThePilotFlies) {
  EXPECT_FALSE(at(0.0).hold);
  supervisor_.pilotArrived(Time::fromSeconds(1), true);
  supervisor_.pilotArrived(Time::fromSeconds(1.02), true);
  EXPECT_TRUE(at(1.1).hold);
  EXPECT_EQ(at(1.1).hold_reason, "the pilot flies");
  EXPECT_TRUE(supervisor_.pilotFlies());
  supervisor_.pilotArrived(Time::fromSeconds(9), false);
  EXPECT_FALSE(at(9.1).hold);
  EXPECT_EQ(log_.take().size(), 2u);
}

TEST_F(SupervisorStory, APilotWhoIsSilentNoLongerFliesAndTheVehicleHolds) {
  at(0.0);
  supervisor_.pilotArrived(Time::fromSeconds(1), true);
  EXPECT_TRUE(at(1.9).hold);
  EXPECT_TRUE(supervisor_.pilotFlies());
  EXPECT_TRUE(at(2.1).hold);
  EXPECT_FALSE(supervisor_.pilotFlies());
  EXPECT_EQ(at(2.1).hold_reason, "the operator holds") << "the mission does not go on by itself";
  EXPECT_THAT(log_.take().back().reason, HasSubstr("no sample from the pilot for 1.0 s"));
  ASSERT_TRUE(supervisor_.take({1, common::ResumeCommand{}}, Time::fromSeconds(5))->accepted);
  EXPECT_FALSE(at(5.0).hold);
}

TEST_F(SupervisorStory, SaysThatTheChargeIsCountedOn) {
  at(1.0);
  gauge_fault_ = "no battery sample for 2.5 s";
  at(2.0);
  at(3.0);
  gauge_fault_.clear();
  at(4.0);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].text, "the charge is estimated by the current drawn");
  EXPECT_EQ(events[0].reason, "no battery sample for 2.5 s");
  EXPECT_EQ(events[1].text, "battery gauge trusted again");
}

TEST_F(SupervisorStory, LandsWherePeopleLeaveNoCourseAndNotForOneScan) {
  at(1.0);
  people_all_round_ = "no course is free of people";
  EXPECT_FALSE(at(1.05).land);
  people_all_round_.clear();
  at(1.1);
  people_all_round_ = "no course is free of people";
  EXPECT_FALSE(at(1.15).land);
  EXPECT_FALSE(at(1.4).land);
  EXPECT_TRUE(at(1.5).land);
  EXPECT_EQ(supervisor_.supervision().land_reason, "no course is free of people");
  people_all_round_.clear();
  EXPECT_TRUE(at(2.0).land) << "it does not climb into whoever comes next";
  EXPECT_EQ(log_.take().back().text, "land");
}

TEST_F(SupervisorStory, LeavesGoalsToTheMission) {
  EXPECT_FALSE(supervisor_.take({1, common::GoalCommand{}}, Time{}).has_value());
  EXPECT_FALSE(supervisor_.take({2, common::HomeCommand{}}, Time{}).has_value());
}

TEST_F(SupervisorStory, ResumeSaysWhyItChangesNothing) {
  scanAt(1.0);
  EXPECT_EQ(supervisor_.take({1, common::ResumeCommand{}}, Time{})->reason, "nothing is on hold");
  at(1.4);
  const auto refused = supervisor_.take({2, common::ResumeCommand{}}, Time{});
  EXPECT_FALSE(refused->accepted);
  EXPECT_THAT(refused->reason, HasSubstr("the laser is silent"));
}

TEST_F(SupervisorStory, RefusesEverythingButLandWhileTheVehicleLands) {
  at(1.0);
  const common::OperatorCommand hold{1, common::HoldCommand{}};
  EXPECT_EQ(supervisor_.refusal(hold), "");
  during(2.0, common::FlightState::kLanding);
  EXPECT_EQ(supervisor_.refusal(hold), "the vehicle is landing") << "the mission's own landing";
  at(3.0);
  (void)supervisor_.take({1, common::LandCommand{}}, Time::fromSeconds(3));
  EXPECT_EQ(supervisor_.refusal(hold), "the vehicle is landing: the operator asked for it");
  EXPECT_EQ(supervisor_.refusal({2, common::LandCommand{}}), "");
  at(4.0, false);
  EXPECT_EQ(supervisor_.refusal(hold), "") << "it stands";
}

TEST_F(SupervisorStory, GoesHomeAndHoldsThereUntilResume) {
  at(0.0, false);
  EXPECT_FALSE(supervisor_.goHome({1, common::HomeCommand{}}).accepted) << "it is not flying";
  at(1.0);
  EXPECT_TRUE(supervisor_.goHome({2, common::HomeCommand{}}).accepted);
  EXPECT_EQ(at(1.1).home, 1u);
  EXPECT_TRUE(at(1.1).hold) << "the mission holds";
  supervisor_.homeEnded(Time::fromSeconds(9), true, {});
  EXPECT_EQ(at(9.1).home, 0u);
  EXPECT_EQ(at(9.1).hold_reason, "the operator holds");
  ASSERT_TRUE(supervisor_.take({3, common::ResumeCommand{}}, Time::fromSeconds(10))->accepted);
  EXPECT_FALSE(at(10.0).hold);
}

TEST_F(SupervisorStory, WithoutAMissionItWaitsAtHomeAndHoldsNothing) {
  at(1.0);
  EXPECT_EQ(supervisor_.goHome({1, common::HomeCommand{}}, AtHome::kWaitForMission).reason,
            "the vehicle holds there until a mission is started");
  EXPECT_EQ(at(1.1).home, 1u);
  EXPECT_EQ(supervisor_.holdReason(), "the operator sent it home") << "for a mission that is started meanwhile";
  supervisor_.homeEnded(Time::fromSeconds(9), true, {});
  EXPECT_FALSE(at(9.1).hold) << "a mission that is started is flown without Resume";
  EXPECT_EQ(log_.take().back().reason, "the vehicle holds until a mission is started, or it lands");
}

TEST_F(SupervisorStory, HoldStopsTheFlightHome) {
  at(1.0);
  EXPECT_TRUE(supervisor_.goHome({1, common::HomeCommand{}}).accepted);
  ASSERT_TRUE(supervisor_.take({2, common::HoldCommand{}}, Time::fromSeconds(2))->accepted);
  EXPECT_EQ(at(2.0).home, 0u);
  EXPECT_TRUE(at(2.0).hold);
}

TEST_F(SupervisorStory, SilentLaserHoldsThenLandsForGood) {
  scanAt(1.0);
  EXPECT_FALSE(at(1.2).hold);
  EXPECT_TRUE(at(1.4).hold);
  EXPECT_FALSE(at(1.4).land);
  EXPECT_FALSE(at(4.2).land) << "three seconds of silence end no flight";
  EXPECT_TRUE(at(4.4).land);
  EXPECT_THAT(at(4.4).land_reason, HasSubstr("no scan for 3.4 s"));
  scanAt(4.5);
  EXPECT_TRUE(at(4.6).land) << "landing is not taken back";
}

TEST_F(SupervisorStory, ASilentLaserOnlyHoldsWhileOtherSensorsMeasureThePosition) {
  measured_ = true;
  scanAt(1.0);
  EXPECT_TRUE(at(1.4).hold);
  EXPECT_THAT(log_.take().back().reason, HasSubstr("other sensors measure the position"));
  EXPECT_FALSE(at(6.0).land);
  measured_ = false;
  EXPECT_TRUE(at(6.1).land) << "the position is lost too";
}

TEST_F(SupervisorStory, NobodyHoldsBlindForLong) {
  measured_ = true;
  scanAt(1.0);
  EXPECT_FALSE(at(10.9).land);
  EXPECT_TRUE(at(11.1).land);
}

TEST_F(SupervisorStory, ShortSilenceOnlyHolds) {
  scanAt(1.0);
  EXPECT_TRUE(at(1.5).hold);
  scanAt(1.6);
  EXPECT_FALSE(at(1.7).hold);
  EXPECT_FALSE(at(1.7).land);
}

TEST_F(SupervisorStory, SilenceOnTheGroundDoesNotLand) {
  scanAt(1.0);
  EXPECT_FALSE(at(30.0, false).land);
  EXPECT_FALSE(at(30.0, false).hold);
}

TEST_F(SupervisorStory, EmptyBatteryLands) {
  energy_.battery_remaining = 0.5;
  EXPECT_FALSE(at(1.0).land);
  energy_.battery_remaining = 0.1;
  EXPECT_TRUE(at(1.1).land);
  EXPECT_FALSE(supervisor_.landedByOperator());
}

TEST_F(SupervisorStory, TurnsBackWhileTheChargeSufficesAndLandsAtHome) {
  energy_.battery_remaining = 0.25;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  energy_.home_planned = true;
  EXPECT_EQ(at(1.0).home, 0u);
  energy_.battery_remaining = 0.19;
  EXPECT_EQ(at(2.0).home, 1u);
  EXPECT_THAT(
      at(2.0).hold_reason,
      HasSubstr("turned back with 19 % of the battery left, 5 % to fly 20.0 m home, and 12 % at which it lands"));
  EXPECT_FALSE(supervisor_.take({1, common::ResumeCommand{}}, Time::fromSeconds(3))->accepted);
  supervisor_.homeEnded(Time::fromSeconds(30), true, {});
  EXPECT_TRUE(at(30.0).land);
  EXPECT_THAT(at(30.0).land_reason, HasSubstr("home reached, turned back"));
}

TEST_F(SupervisorStory, AMissionThatFliesHomeIsNotTurnedBack) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  energy_.home_planned = true;
  goes_home_ = true;
  EXPECT_EQ(at(1.0).home, 0u);
  goes_home_ = false;  // It could not get there.
  EXPECT_EQ(at(2.0).home, 1u);
}

TEST_F(SupervisorStory, AMissionThatHasFailedFliesHomeAndLandsThere) {
  at(1.0);
  supervisor_.missionFailed(Time::fromSeconds(1.5), "goal (6.00, 2.00) is unreachable");
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "the mission has failed: the vehicle flies home");
  EXPECT_EQ(events[0].reason, "goal (6.00, 2.00) is unreachable");
  EXPECT_EQ(at(2.0).home, 1u);
  EXPECT_EQ(at(2.0).flown_by, common::FlownBy::kSupervisor);
  EXPECT_EQ(supervisor_.refusal({1, common::GoalCommand{}}),
            "the vehicle flies home and lands there: the mission has failed");
  supervisor_.homeEnded(Time::fromSeconds(30), true, {});
  EXPECT_TRUE(at(30.0).land);
  EXPECT_EQ(at(30.0).land_reason, "home reached, the mission has failed");
}

TEST_F(SupervisorStory, AfterAFailedMissionItLandsWhereThePathHomeEnds) {
  at(1.0);
  supervisor_.missionFailed(Time::fromSeconds(1.5), "");
  supervisor_.homeEnded(Time::fromSeconds(30), false, "a person at (1.00, 0.00) is in the way");
  EXPECT_TRUE(at(30.0).land);
  EXPECT_EQ(at(30.0).land_reason, "the mission has failed; home not reached: a person at (1.00, 0.00) is in the way");
}

/// A maneuver that waits gives up while the supervisor would still let it, so that the mission decides what is next.
TEST_F(SupervisorStory, TheTimeToSpareEndsShortlyBeforeItTurnsBack) {
  constexpr double kPerSecond = 0.001;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  energy_.home_planned = true;
  const SupervisorConfig config;
  std::optional<double> gives_up_s, turns_back_s;
  for (double t_s = 0.0; t_s < 1000.0 && !turns_back_s; t_s += 0.1) {
    energy_.battery_remaining = 0.9 - kPerSecond * t_s;
    energy_.seconds_left = (energy_.battery_remaining - config.battery_land_share) / kPerSecond;
    if (!gives_up_s && spareTime_s(energy_, config) <= 0.0) gives_up_s = t_s;
    if (at(t_s).home > 0) turns_back_s = t_s;
  }
  ASSERT_TRUE(gives_up_s && turns_back_s);
  EXPECT_NEAR(*turns_back_s, (0.9 - 0.12 - 0.02 - 1.15 * 0.05) / kPerSecond, 0.2);
  EXPECT_NEAR(*turns_back_s - *gives_up_s, 5.0, 0.2);
}

TEST(SpareTime, IsNoneBelowTheChargeAtWhichItLandsAndUnboundedWhileNothingIsKnown) {
  common::EnergyLayer energy;
  const SupervisorConfig config;
  EXPECT_EQ(spareTime_s(energy, config), std::numeric_limits<double>::infinity());
  energy.seconds_left = 300.0;
  EXPECT_EQ(spareTime_s(energy, config), std::numeric_limits<double>::infinity()) << "the flight home is not known";
  energy.home_share = 0.05;
  EXPECT_LT(spareTime_s(energy, config), 300.0);
  const double spare_s = spareTime_s(energy, config);
  energy.land_share = 0.4;  // The thrust gives out earlier.
  EXPECT_LT(spareTime_s(energy, config), spare_s);
  energy.battery_remaining = 0.3;
  EXPECT_EQ(spareTime_s(energy, config), 0.0);
}

TEST_F(SupervisorStory, HoldStopsAFlightHomeForTheChargeUntilResume) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  EXPECT_EQ(at(2.0).home, 1u);
  ASSERT_TRUE(supervisor_.take({1, common::HoldCommand{}}, Time::fromSeconds(3))->accepted);
  EXPECT_EQ(at(3.0).home, 0u);
  EXPECT_EQ(at(3.0).hold_reason, "the operator holds");
  const auto resumed = supervisor_.take({2, common::ResumeCommand{}}, Time::fromSeconds(4));
  EXPECT_TRUE(resumed->accepted);
  EXPECT_THAT(resumed->reason, HasSubstr("it flies home: turned back with 19 %"));
  EXPECT_EQ(at(4.0).home, 1u);
  EXPECT_TRUE(at(4.0).hold) << "the mission stays on hold";
}

TEST_F(SupervisorStory, AVehicleThatLandsWhereItIsDoesNotTurnBack) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  lands_ = true;
  EXPECT_EQ(at(2.0).home, 0u);
  EXPECT_FALSE(at(2.0).hold);
  lands_ = false;
  EXPECT_EQ(at(3.0).home, 1u);
}

TEST_F(SupervisorStory, TurnsBackWithoutAKnownPathAndSaysSo) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  EXPECT_EQ(at(2.0).home, 1u);
  EXPECT_THAT(at(2.0).hold_reason, HasSubstr("5 % to fly 20.0 m home along its trail, as no path is known"));
}

TEST_F(SupervisorStory, TellsOnceThatHomeIsOutOfReach) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  energy_.home_planned = true;
  at(2.0);
  EXPECT_EQ(log_.take().size(), 3u) << "below 30 %, below 20 %, turn back";
  energy_.home_share = 0.10;
  at(3.0);
  at(4.0);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "home is out of reach");
  EXPECT_EQ(events[0].reason, "10 % to fly 20.0 m home, 7 % left to fly with: it lands on the way");
}

TEST_F(SupervisorStory, TheTakeOffIsRefusedWithTheFigure) {
  const auto refusal = [this] { return at(1.0, false).take_off_refusal; };
  energy_.battery_voltage_v = 0.0;
  EXPECT_EQ(refusal(), "the battery has not been measured");
  energy_.battery_voltage_v = 11.1;
  energy_.thrust_margin = 1.00;
  EXPECT_EQ(refusal(), "the thrust is at most 1.00 times the weight; 1.01 is needed");
  energy_.thrust_margin = 1.3;
  EXPECT_EQ(refusal(), "");
  energy_.battery_remaining = 0.13;
  EXPECT_EQ(refusal(), "13 % of the battery are left; 14 % are needed, and it lands at 12 %");
  EXPECT_EQ(at(2.0).take_off_refusal, "") << "it flies";
}

TEST_F(SupervisorStory, TheChargeIsTheSubjectOfTwoEvents) {
  for (const double remaining : {0.5, 0.29, 0.28, 0.19, 0.18}) {
    energy_.battery_remaining = remaining;
    at(1.0);
  }
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].text, "29 % of the battery left");
  EXPECT_EQ(events[1].text, "19 % of the battery left");
}

TEST_F(SupervisorStory, LandsWhileItCanStillClimb) {
  energy_.thrust_margin = 1.00;
  EXPECT_FALSE(at(1.0).land);
  EXPECT_FALSE(at(1.5).land) << "a gust may take the margin for a moment";
  EXPECT_TRUE(at(2.1).land);
  EXPECT_THAT(at(2.1).land_reason, HasSubstr("1.00 times the weight"));
}

TEST_F(SupervisorStory, FliesBackWhenTheHeightIsUnseenAndGoesOnWhenItIsSeenAgain) {
  vertical_age_s_ = 0.4;
  EXPECT_EQ(at(1.0).back, 0u);
  vertical_age_s_ = 0.6;
  EXPECT_EQ(at(1.2).back, 1u);
  EXPECT_EQ(at(1.2).hold_reason, "it flies back along its trail");
  vertical_age_s_ = 0.0;
  EXPECT_EQ(at(3.0).back, 1u) << "well over the place where it was seen";
  EXPECT_EQ(at(4.1).back, 0u);
  EXPECT_FALSE(at(4.1).hold);
}

TEST_F(SupervisorStory, LandsWhereFlyingBackToTheStartDidNotHelp) {
  drift_m_ = 1.2;
  EXPECT_EQ(at(1.0).back, 1u);
  supervisor_.backEnded(Time::fromSeconds(9));
  EXPECT_TRUE(at(9.0).land);
  EXPECT_THAT(at(9.0).land_reason, HasSubstr("the position is uncertain by 1.2 m, also after flying back"));
  (void)log_.take();
  EXPECT_EQ(at(9.5).back, 0u) << "it lands, wherever it is";
  EXPECT_THAT(log_.take(), testing::IsEmpty());
}

TEST_F(SupervisorStory, LandsAtOnceWhenThePositionIsTooUncertain) {
  drift_m_ = kDriftLand_m + 0.1;
  EXPECT_TRUE(at(1.0).land);
}

TEST_F(SupervisorStory, InTheOpenItFliesBackInsideBeforeItLands) {
  vertical_age_s_ = 0.0;
  walls_around_ = false;
  drift_m_ = kDriftLand_m + 0.1;
  EXPECT_FALSE(at(1.0).land);
  EXPECT_EQ(at(1.0).back, 1u);
  walls_around_ = true;
  EXPECT_TRUE(at(9.0).land);
}

TEST_F(SupervisorStory, ALostVehicleInTheOpenLandsInTheEnd) {
  walls_around_ = false;
  drift_m_ = 2.0 * kDriftLand_m + 0.1;
  EXPECT_TRUE(at(1.0).land);
}

TEST_F(SupervisorStory, LandPressedTwiceIsStillALandingByTheOperator) {
  (void)supervisor_.take({1, common::LandCommand{}}, Time::fromSeconds(1.0));
  EXPECT_TRUE(at(1.1).land);
  (void)supervisor_.take({2, common::LandCommand{}}, Time::fromSeconds(1.2));
  EXPECT_TRUE(supervisor_.landedByOperator());
}

TEST_F(SupervisorStory, LandsWhenASensorLiesInTheAir) {
  sensor_lies_ = "the accelerometer contradicts the thrust";
  EXPECT_FALSE(at(1.0, false).land) << "on the ground it does not matter";
  EXPECT_TRUE(at(1.1).land);
  sensor_lies_.clear();
  EXPECT_TRUE(at(1.2).land) << "for good";
  EXPECT_EQ(at(1.2).land_reason, "the accelerometer contradicts the thrust");
}

TEST_F(SupervisorStory, EachChangeIsAnEventWithItsReason) {
  scanAt(1.0);
  at(1.4);
  at(1.5);
  scanAt(1.6);
  at(1.6);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, "hold");
  EXPECT_THAT(events[0].reason, HasSubstr("no scan"));
  EXPECT_EQ(events[1].text, "scans are back");
}

}  // namespace
}  // namespace swiftlet::autonomy
