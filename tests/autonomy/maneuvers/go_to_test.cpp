// GoTo: goals that are flown to, waited for, reached by a detour, and given up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kFreeCell;
using planning::test::kWallCell;
using testing::HasSubstr;
using testing::StartsWith;

constexpr common::CellRect kDoor{{80, 28}, {81, 52}};  ///< 1.2 m wide, in the wall at x = 4 m, about y = 2 m.

TEST_F(ManeuverStory, GoToFailsOnTheGround) {
  want(to(6.0, 2.0));
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot fly to a goal while powered off");
}

TEST_F(ManeuverInFlight, AGoalAfterALandingFailsWithTheReasonOfTheLanding) {
  state_.horizontal_valid = false;
  want(to(6.0, 2.0));
  EXPECT_EQ(runToTheEnd(5.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot fly to a goal: landing because no horizontal estimate for 3.0 s");
  runUntil([this] { return controller_.state() == FlightState::kLanded; }, 10.0);
  want(to(6.0, 2.0));
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot fly to a goal: landed because no horizontal estimate for 3.0 s");
}

class GoToManeuver : public ManeuverInFlight {
 protected:
  /// Another wall, at x = 4 m.
  void build(bool open) {
    fill(grid_, {{80, 0}, {81, 80}}, kWallCell);
    if (open) fill(grid_, kDoor, kFreeCell);
  }
  long detours() const { return timesSaid("moves closer to look") + timesSaid("moves aside to make room"); }
};

TEST_F(GoToManeuver, FliesThroughTheDoorToTheGoal) {
  build(true);
  want(to(6.0, 3.2));
  run(0.5);
  EXPECT_TRUE(controller_.follower().followsPath());
  EXPECT_FALSE(executor_.status().released);
  EXPECT_GT(executor_.aim().velocity_map_m_s.x(), 0.5);
  EXPECT_EQ(executor_.aim().goal_map_m, Eigen::Vector2d(6.0, 3.2));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "reached (6.00, 3.20)");
  EXPECT_LT(distanceTo_m({6.0, 3.2}), 0.05);
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
}

TEST_F(GoToManeuver, FliesToTheNearestFreePlaceInsteadOfAGoalThatIsNotFree) {
  build(true);
  common::GoToIntent home = to(6.0, 3.2);
  fill(grid_, {{122, 60}, {126, 70}}, kWallCell);  // 0.1 m beside the goal.
  want(home);
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed) << "the tolerance is 5 cm";
  home.shift_m = 0.5;
  want(home);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_THAT(executor_.status().reason, HasSubstr("beside the goal, which is not free"));
  EXPECT_LT(distanceTo_m({6.0, 3.2}), 0.5);
}

TEST_F(GoToManeuver, AGoalIsShiftedOnlyAfterItHasNotBeenFreeForAWhile) {
  build(true);
  common::GoToIntent goal = to(6.0, 3.2);
  goal.shift_m = 0.5;
  goal.shift_after_s = 5.0;
  constexpr common::CellRect kBeside{{122, 60}, {126, 70}};  // 0.1 m beside the goal.
  fill(grid_, kBeside, kWallCell);
  want(goal);
  run(2.0);
  EXPECT_THAT(executor_.status().reason, HasSubstr("waiting: goal (6.00, 3.20) is too close"));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_THAT(executor_.status().reason, HasSubstr("beside the goal, which is not free"));
  place(1.5, 2.0);
  goal.goal_map_m.x() += 0.01;
  want(goal);
  run(3.0);
  fill(grid_, kBeside, kFreeCell);  // What stood there has gone.
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "reached (6.01, 3.20)");
}

TEST_F(GoToManeuver, FliesToAPlaceAtTheEdgeOfTheToleranceItself) {
  build(true);
  common::GoToIntent goal = to(6.0, 3.2);
  goal.shift_m = 0.5;
  fill(grid_, {{122, 60}, {126, 70}}, kWallCell);  // 0.1 m beside the goal.
  want(goal);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  goal.tolerance_m = distanceTo_m({6.0, 3.2}) / 0.9;
  place(1.5, 2.0);
  want(goal);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_THAT(executor_.status().reason, HasSubstr("beside the goal, which is not free"))
      << "a tenth of the tolerance is left for the controller";
}

TEST_F(GoToManeuver, TheTimeWithoutAPathToAFreeGoalDoesNotShiftItLater) {
  build(false);
  common::GoToIntent goal = to(6.0, 3.2);
  goal.shift_m = 0.5;
  goal.shift_after_s = 2.0;
  want(goal);
  run(4.0);
  EXPECT_EQ(detours(), 1);
  build(true);
  fill(grid_, {{122, 60}, {126, 70}}, kWallCell);  // 0.1 m beside the goal.
  run(1.5);
  EXPECT_THAT(executor_.status().reason, HasSubstr("waiting: goal (6.00, 3.20) is too close"));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_THAT(executor_.status().reason, HasSubstr("beside the goal, which is not free"));
}

TEST_F(GoToManeuver, NamesThePlaceAsTheMissionDoesInTheGivenMap) {
  build(true);
  common::GoToIntent goal = to(6.0, 3.2);
  goal.goal_given_m = Eigen::Vector2d(-1.0, 7.5);
  want(goal);
  run(0.5);
  EXPECT_EQ(executor_.status().reason, "flying to (-1.00, 7.50) in the given map");
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "reached (-1.00, 7.50) in the given map");
  fill(grid_, {{122, 60}, {126, 70}}, kWallCell);  // 0.1 m beside the goal.
  goal.shift_m = 0.5;
  goal.goal_map_m.x() += 0.05;
  want(goal);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_THAT(executor_.status().reason, HasSubstr(" m beside (-1.00, 7.50) in the given map, which is not free"));
}

TEST_F(GoToManeuver, SucceedsOnceNearAndSlowForAWhile) {
  follows_ = false;
  want(to(2.0, 2.0));
  const auto stillRuns = [this](double seconds) {
    run(seconds);
    return executor_.status().state == IntentState::kRunning;
  };
  place(2.0, 2.0);
  state_.velocity_odom_m_s = {0.2, 0.0, 0.0};
  EXPECT_TRUE(stillRuns(1.0)) << "too fast";
  place(2.0, 2.06);
  EXPECT_TRUE(stillRuns(1.0)) << "too far";
  place(2.0, 2.0);
  state_.T_odom_body.position_m.z() = kHeight_m + 0.15;
  EXPECT_TRUE(stillRuns(1.0)) << "too high";
  state_.T_odom_body.position_m.z() = kHeight_m;
  EXPECT_TRUE(stillRuns(0.2)) << "too short";
  place(2.0, 2.06);
  EXPECT_TRUE(stillRuns(0.1));
  place(2.0, 2.0);
  EXPECT_TRUE(stillRuns(0.2)) << "the time counts from when it came back";
  EXPECT_FALSE(stillRuns(0.2));
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
}

TEST_F(GoToManeuver, WaitsForAPathAndFliesADetourToLook) {
  build(false);
  want(to(6.0, 2.0));
  run(2.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_THAT(executor_.status().reason, StartsWith("waiting: goal (6.00, 2.00) is unreachable"));
  EXPECT_EQ(timesSaid("no path to the goal at present"), 1);
  EXPECT_EQ(detours(), 0);
  EXPECT_LT(distanceTo_m({1.5, 2.0}), 0.05) << "meanwhile it stays";
  run(1.0);
  EXPECT_EQ(timesSaid("moves closer to look"), 1);
  run(3.0);
  EXPECT_NEAR(position_m().x(), 4.0 - 0.375, 0.2);
  run(3.0);
  EXPECT_EQ(detours(), 2) << "having looked, it looks from elsewhere";
  run(6.0);
  EXPECT_EQ(detours(), 2) << "and stays there";
  fill(grid_, kDoor, kFreeCell);
  run(0.5);
  ASSERT_FALSE(executor_.remainingPlan_map_m().empty());
  EXPECT_EQ(executor_.remainingPlan_map_m().back(), Eigen::Vector2d(6.0, 2.0)) << "asked for on the detour too";
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(GoToManeuver, MakesRoomForAPersonInTheDoor) {
  build(true);
  discs_ = {{{4.0, 2.0}, 0.5}};
  want(to(6.0, 2.0));
  runUntil([this] { return detours() > 0; }, 5.0);
  EXPECT_EQ(timesSaid("moves aside to make room"), 1);
  discs_.clear();
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(GoToManeuver, FailsWithThePlannersReasonWhenNoPathAppears) {
  build(false);
  want(to(6.0, 2.0));
  EXPECT_NEAR(runUntil([this] { return ended(); }, 60.0), 35.1, 0.3);
  EXPECT_EQ(executor_.status().state, IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "goal (6.00, 2.00) is unreachable at clearance 0.10 m");
  EXPECT_FALSE(controller_.follower().followsPath());
}

/// It waits where it sees the door, and does not shuttle, as long as the charge allows.
TEST_F(GoToManeuver, WaitsForAPersonAsLongAsTheChargeAllows) {
  build(true);
  people_ = {{1, {4.0, 2.0}, 0.25, {0.5, 0.0}, true, {}}};
  discs_ = {{{4.0, 2.0}, 0.5}};
  want(to(6.0, 2.0));
  run(100.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_THAT(executor_.status().reason, StartsWith("waiting: a person at (4.00, 2.00) is in the way"));
  EXPECT_EQ(detours(), 1);
  spare_s_ = -1.0;
  EXPECT_EQ(runToTheEnd(1.0), IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, StartsWith("a person at (4.00, 2.00) is in the way: goal (6.00, 2.00)"));
}

/// Without any charge to spare it still waits until somebody who passes has passed.
TEST_F(GoToManeuver, WaitsForSomebodyWhoPassesWithoutAnyChargeToSpare) {
  build(true);
  spare_s_ = -1.0;
  discs_ = {{{4.0, 2.0}, 0.5}};
  want(to(6.0, 2.0));
  run(9.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  discs_.clear();
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(GoToManeuver, FailsSoonForAGoalInSpaceNeverSeen) {
  want(to(8.5, 2.0));
  EXPECT_NEAR(runUntil([this] { return ended(); }, 30.0), 2.1, 0.3);
  EXPECT_EQ(executor_.status().state, IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, HasSubstr("space never seen"));
  EXPECT_EQ(detours(), 0);
}

TEST_F(GoToManeuver, DropsABlockedPlanAndHolds) {
  build(true);
  want(to(6.0, 2.0));
  runUntil([this] { return position_m().x() > 2.0; }, 10.0);
  ASSERT_TRUE(controller_.follower().followsPath());
  fill(grid_, kDoor, kWallCell);
  EXPECT_LT(runUntil([this] { return timesSaid("plan discarded") > 0; }, 5.0), 0.5);
  EXPECT_THAT(reasonOf("plan discarded"), StartsWith("blocked before"));
  EXPECT_FALSE(controller_.follower().followsPath());
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
  run(1.5);
  EXPECT_TRUE(controller_.stopped());
  EXPECT_LT(position_m().x(), 4.0 - 0.375);
  fill(grid_, kDoor, kFreeCell);
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(timesSaid("plan discarded"), 1);
}

TEST_F(GoToManeuver, ResendsAPathThatWasDroppedWithTheEstimate) {
  want(to(6.5, 2.0));
  run(1.0);
  ASSERT_TRUE(controller_.follower().followsPath());
  state_.horizontal_valid = false;
  run(0.03);
  ASSERT_FALSE(controller_.follower().followsPath()) << "the controller holds";
  state_.horizontal_valid = true;
  run(0.5);
  EXPECT_TRUE(controller_.follower().followsPath());
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

/// Nothing is reached while the position is not known, and a place whose own error is not known is not reached.
TEST_F(GoToManeuver, DoesNotArriveWhereItDoesNotKnowThatItIs) {
  want(to(3.0, 2.0));
  runUntil([this] { return distanceTo_m({3.0, 2.0}) < 0.02; }, 15.0);
  state_.horizontal_valid = false;
  run(0.8);
  EXPECT_FALSE(ended());
  EXPECT_EQ(executor_.status().reason, "the position is not known");
  state_.horizontal_valid = true;
  drift_m_ = 0.4;
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason,
            "the position is uncertain by 0.4 m: whether it has reached (3.00, 2.00) cannot be told");
}

/// The controller drops its path when the estimate is back, and starts from its present place.
TEST_F(GoToManeuver, ResendsAPathThatWasSentWithoutAnEstimate) {
  want(to(6.5, 2.0));
  run(1.0);
  state_.horizontal_valid = false;
  run(0.5);
  state_.horizontal_valid = true;
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(GoToManeuver, FliesInTheModeOfTheIntent) {
  common::GoToIntent careful = to(6.5, 2.0);
  careful.mode = common::FlightMode::kCareful;
  want(careful);
  runUntil([this] { return position_m().x() > 3.0; }, 15.0);
  EXPECT_NEAR(state_.velocity_odom_m_s.norm(), controller_.follower().speed_m_s(common::FlightMode::kCareful), 0.02);
  EXPECT_NEAR(executor_.aim().velocity_map_m_s.norm(), controller_.follower().speed_m_s(common::FlightMode::kCareful),
              1e-9);
}

class GoToWithWavefront : public ManeuverInFlight {
 protected:
  GoToWithWavefront() : ManeuverInFlight(Choices{planning::PlannerKind::kWavefront}) {}
};

TEST_F(GoToWithWavefront, UsesThePlannerOfTheProfile) {
  fill(grid_, {{80, 0}, {81, 80}}, kWallCell);
  fill(grid_, kDoor, kFreeCell);
  want(to(6.0, 3.2));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({6.0, 3.2}), 0.05);
  EXPECT_EQ(executor_.desk().use().planner, "wavefront");
  EXPECT_GT(executor_.desk().use().paths, 5) << "asked again while it flies";
}

TEST_F(GoToManeuver, UsesDStarLiteByDefault) {
  want(to(6.0, 3.2));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.desk().use().planner, "D* Lite");
  EXPECT_GT(executor_.desk().use().paths, 5);
}

TEST_F(GoToManeuver, FliesAtTheHeightOfAGoalAndKeepsItForTheNextGoal) {
  common::GoToIntent high = to(3.0, 2.0);
  high.height_m = 1.4;
  want(high);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), 1.4, 0.05);
  want(to(4.0, 2.0));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), 1.4, 0.05);
}

}  // namespace
}  // namespace swiftlet::autonomy
