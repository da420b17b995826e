// The table of fail-safes: ranked, complete, and what it says of several findings at once.
#include "control/failsafe.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace swiftlet::control {
namespace {

TEST(Failsafe, OfSeveralFindingsTheHighestRowIsActive) {
  const std::vector findings{FindingKind::kChargeForHome, FindingKind::kSurroundingsUnseen,
                             FindingKind::kChargeBelow30};
  EXPECT_EQ(activeFailsafe(findings, FlightPhase::kFlying)->response, Response::kHold);
  const std::vector worse{FindingKind::kSurroundingsUnseen, FindingKind::kHeightLost, FindingKind::kThrustSpent};
  EXPECT_EQ(activeFailsafe(worse, FlightPhase::kFlying)->response, Response::kDescend);
  EXPECT_EQ(activeFailsafe({}, FlightPhase::kFlying), nullptr);
}

TEST(Failsafe, OnTheGroundNothingFlies) {
  for (const Failsafe& row : failsafes()) {
    if (!row.phases[static_cast<std::size_t>(FlightPhase::kOnGround)]) continue;
    EXPECT_NE(row.response, Response::kLand) << toString(row.finding);
    EXPECT_NE(row.response, Response::kFlyHome) << toString(row.finding);
    EXPECT_NE(row.response, Response::kFlyBack) << toString(row.finding);
    EXPECT_NE(row.response, Response::kDescend) << toString(row.finding);
  }
}

TEST(Failsafe, AFindingHasAtMostOneRowInAPhase) {
  std::set<std::pair<FindingKind, FlightPhase>> seen;
  for (const Failsafe& row : failsafes())
    for (const FlightPhase phase : kFlightPhases) {
      if (!row.phases[static_cast<std::size_t>(phase)]) continue;
      EXPECT_TRUE(seen.insert({row.finding, phase}).second) << toString(row.finding) << " " << toString(phase);
      EXPECT_EQ(failsafeFor(row.finding, phase), &row);
    }
}

TEST(Failsafe, ALandingDoesNotEndInTheAir) {
  for (const Failsafe& row : failsafes())
    EXPECT_TRUE(row.response < Response::kLand || row.ends == Ends::kNever) << toString(row.finding);
}

}  // namespace
}  // namespace swiftlet::control
