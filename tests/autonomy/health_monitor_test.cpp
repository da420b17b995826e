// Findings: their hysteresis, their phases, and that each check has its row in the table of fail-safes.
#include "autonomy/health/health_monitor.hpp"

#include <string>

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Time;
using control::FindingKind;

class HealthStory : public testing::Test {
 protected:
  void at(double t_s, common::FlightState flight = common::FlightState::kFlying) {
    condition_.flight = flight;
    monitor_.update(Time::fromSeconds(t_s), condition_);
  }
  bool finds(FindingKind what) const { return monitor_.find(what) != nullptr; }

  VehicleCondition condition_;
  HealthMonitor monitor_{SupervisorConfig{}};
};

TEST_F(HealthStory, AFindingBeginsAfterItsTimeAndTellsSinceWhen) {
  condition_.energy.thrust_margin = 1.0;
  at(1.0);
  EXPECT_FALSE(finds(FindingKind::kThrustSpent));
  at(2.0);
  ASSERT_TRUE(finds(FindingKind::kThrustSpent));
  EXPECT_EQ(monitor_.find(FindingKind::kThrustSpent)->since, Time::fromSeconds(1.0));
  EXPECT_DOUBLE_EQ(monitor_.find(FindingKind::kThrustSpent)->reading.bound, 1.01);
}

TEST_F(HealthStory, AnUncertainPositionEndsByANarrowerBoundAndAfterATime) {
  condition_.drift_m = 1.1;
  at(1.0);
  ASSERT_TRUE(finds(FindingKind::kPositionUncertain));
  condition_.drift_m = 0.8;
  at(10.0);
  EXPECT_TRUE(finds(FindingKind::kPositionUncertain));
  EXPECT_FALSE(monitor_.find(FindingKind::kPositionUncertain)->reading.beyond);
  condition_.drift_m = 0.4;
  at(11.0);
  EXPECT_TRUE(finds(FindingKind::kPositionUncertain));
  at(12.0);
  EXPECT_FALSE(finds(FindingKind::kPositionUncertain));
  EXPECT_EQ(monitor_.left(), std::vector{FindingKind::kPositionUncertain});
}

TEST_F(HealthStory, ASilentLaserNeitherFindsNorEndsAnUnmeasuredHeight) {
  condition_.vertical_age_s = 0.6;
  condition_.unseen_s = 0.4;
  at(1.0);
  EXPECT_FALSE(finds(FindingKind::kHeightUnmeasured));
  condition_.unseen_s = 0.0;
  at(2.0);
  ASSERT_TRUE(finds(FindingKind::kHeightUnmeasured));
  condition_.unseen_s = 0.4;
  for (const double t_s : {3.0, 4.0, 5.0}) at(t_s);
  ASSERT_TRUE(finds(FindingKind::kHeightUnmeasured)) << "the height is not known again";
  EXPECT_FALSE(monitor_.find(FindingKind::kHeightUnmeasured)->reading.beyond) << "and does not land the vehicle";
}

TEST_F(HealthStory, WhatStoodBeforeTheTakeOffIsToldAnewInTheAir) {
  condition_.energy.battery_remaining = 0.01;
  at(1.0, common::FlightState::kPreparation);
  ASSERT_TRUE(finds(FindingKind::kChargeSpent));
  const std::string refusal = monitor_.find(FindingKind::kChargeSpent)->why;
  at(2.0, common::FlightState::kTakingOff);
  ASSERT_TRUE(finds(FindingKind::kChargeSpent));
  EXPECT_NE(monitor_.find(FindingKind::kChargeSpent)->why, refusal);
}

TEST_F(HealthStory, WhatNeverEndsInAFlightEndsOnTheGround) {
  condition_.energy.battery_remaining = 0.25;
  at(1.0);
  EXPECT_TRUE(finds(FindingKind::kChargeBelow30));
  condition_.energy.battery_remaining = 0.5;
  at(2.0);
  EXPECT_TRUE(finds(FindingKind::kChargeBelow30)) << "a gauge that recovers tells nothing twice";
  at(3.0, common::FlightState::kLanded);
  at(4.0);
  EXPECT_FALSE(finds(FindingKind::kChargeBelow30));
}

TEST_F(HealthStory, EachRowIsFoundBySomebody) {
  using enum FindingKind;
  const std::set<FindingKind> of_the_flight_controller{kEstimateDiverged, kHeightLost, kInertialUnusable,
                                                       kHorizontalLost};
  for (const control::Failsafe& row : control::failsafes()) {
    const bool found = std::ranges::any_of(checks(), [&](const Check& check) { return check.what == row.finding; });
    EXPECT_NE(found, of_the_flight_controller.contains(row.finding)) << control::toString(row.finding);
  }
}

TEST_F(HealthStory, EachCheckHasARowAndEachPhaseItsOwn) {
  for (const Check& check : checks()) {
    bool any = false;
    for (const control::FlightPhase phase : control::kFlightPhases)
      any = any || control::failsafeFor(check.what, phase) != nullptr;
    EXPECT_TRUE(any) << control::toString(check.what);
  }
  condition_.drift_m = 5.0;
  at(1.0, common::FlightState::kTakingOff);
  EXPECT_TRUE(monitor_.findings().empty()) << "the take-off has rules of its own";
}

}  // namespace
}  // namespace swiftlet::autonomy
