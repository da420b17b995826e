// OperatorCommand: goals and home from the operator, tick by tick; the test plays the autonomy.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;

constexpr const char* kOperator =
    R"(<Priority><AvoidObstacle/><Hold/><Sequence><TakeOff/><OperatorCommand tolerance_m="0.1"/></Sequence></Priority>)";

/// A flight after take-off in which OperatorCommand holds with intent 2.
Flight waiting() {
  Flight flight(kOperator);
  flight.tick();
  flight.succeeds().tick();
  flight.events();
  return flight;
}

TEST(OperatorCommand, HoldsBeforeAndAfterAGoal) {
  Flight flight = waiting();
  EXPECT_EQ(flight.stops().tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.goal(1.0, 2.0).tick(), "RUNNING 3 go to (1.00, 2.00)");
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted"));
  EXPECT_DOUBLE_EQ(std::get<common::GoToIntent>(flight.context.intent->kind).tolerance_m, 0.1);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 3 go to (1.00, 2.00)");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 4 hold");
  EXPECT_THAT(flight.events(), ElementsAre("goal (1.00, 2.00) reached"));
}

TEST(OperatorCommand, ANewGoalReplacesTheOldOne) {
  Flight flight = waiting();
  flight.goal(1.0, 2.0).tick();
  EXPECT_EQ(flight.runs().goal(-1.0, 0.0).tick(), "RUNNING 4 go to (-1.00, 0.00)");
  EXPECT_THAT(flight.events(), ElementsAre("goal (1.00, 2.00) cancelled (replaced by goal (-1.00, 0.00))"));
  EXPECT_EQ(flight.tick(), "RUNNING 4 go to (-1.00, 0.00)") << "answers to intent 3 do not matter";
}

TEST(OperatorCommand, FliesToTheLastOfSeveralGoalsInOneTick) {
  Flight flight = waiting();
  EXPECT_EQ(flight.goal(1.0, 2.0).goal(2.0, 2.0).tick(), "RUNNING 3 go to (2.00, 2.00)");
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted", "2 accepted"));
}

TEST(OperatorCommand, ReportsAnUnreachableGoalAndTheMissionContinues) {
  Flight flight = waiting();
  flight.goal(1.0, 2.0).tick();
  EXPECT_EQ(flight.fails("no path at clearance 0.10 m").tick(), "RUNNING 4 hold");
  EXPECT_THAT(flight.events(), ElementsAre("goal (1.00, 2.00) not reached (no path at clearance 0.10 m)"));
}

TEST(OperatorCommand, GoesHome) {
  Flight flight = waiting();
  EXPECT_EQ(flight.home(0.5, 0.25).homeCommand().tick(), "RUNNING 3 go to (0.50, 0.25)");
  EXPECT_EQ(std::get<common::GoToIntent>(flight.context.intent->kind).shift_m, common::kHomeShift_m)
      << "beside it, if something stands there: as GoHome";
  flight.succeeds().tick();
  EXPECT_THAT(flight.events(), ElementsAre("home reached"));
}

TEST(OperatorCommand, RefusesInvalidGoals) {
  Flight flight = waiting();
  flight.goal(4.05, 0.0)
      .goal(20.0, 0.0)
      .goal(3.9, 0.0)
      .goal(std::nan(""), 0.0)
      .goal(1e300, 0.0)
      .command({0, common::LandCommand{}});
  EXPECT_EQ(flight.tick(), "RUNNING 2 hold");
  EXPECT_THAT(
      flight.results(),
      ElementsAre("1 refused: goal (4.05, 0.00) is in an obstacle at clearance 0.10 m, the nearest free place is "
                  "(3.62, 0.00)",
                  "2 refused: goal (20.00, 0.00) is outside the map",
                  "3 refused: goal (3.90, 0.00) is too close to an obstacle or to unknown space at clearance "
                  "0.10 m, the nearest free place is (3.62, 0.00)",
                  "4 refused: the goal is not a point of the map", "5 refused: the goal is not a point of the map",
                  "6 refused: not a command for the mission"));
}

TEST(OperatorCommand, AcceptsAGoalWithAFreePlaceWithinItsTolerance) {
  Flight flight = waiting();
  flight.goal(3.70, 0.0).tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted")) << "0.075 m beside, of a tolerance of 0.1 m";
}

TEST(OperatorCommand, ShiftsATappedGoalThatIsNotFreeByAFingertip) {
  Flight flight = waiting();
  EXPECT_EQ(flight.goal(3.85, 0.0).tick(), "RUNNING 3 go to (3.62, 0.00)");
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted"));
  EXPECT_THAT(flight.events(),
              ElementsAre("goal (3.85, 0.00) shifted by 0.23 m (to (3.62, 0.00), the nearest free place)"));
  EXPECT_EQ(std::get<common::GoToIntent>(flight.context.intent->kind).shift_m, 0.25)
      << "the place is at the least clearance: a map that changes by a cell must not fail the goal";
}

TEST(OperatorCommand, AGoalThatIsFreeIsFlownToItself) {
  Flight flight = waiting();
  EXPECT_EQ(flight.goal(1.0, 2.0).tick(), "RUNNING 3 go to (1.00, 2.00)");
  EXPECT_EQ(std::get<common::GoToIntent>(flight.context.intent->kind).shift_m, 0.25)
      << "the next scan may show it a cell too near to a wall";
}

TEST(OperatorCommand, JudgesGoalsByItsOwnClearance) {
  Flight flight(R"(<Sequence><TakeOff/><OperatorCommand clearance_m="0.5"/></Sequence>)");
  flight.goal(3.6, 0.0).tick();
  EXPECT_THAT(flight.results(),
              ElementsAre("1 refused: goal (3.60, 0.00) is too close to an obstacle or to unknown space at clearance "
                          "0.50 m, the nearest free place is (3.23, 0.00)"));
}

TEST(OperatorCommand, AcceptsGoalsWithoutAMap) {
  Flight flight = waiting();
  flight.context.goal_map.reset();
  flight.goal(4.05, 0.0).goal(std::nan(""), 0.0).tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted", "2 refused: the goal is not a point of the map"));
}

TEST(OperatorCommand, FliesToAGoalGivenDuringAHoldAfterwards) {
  Flight flight = waiting();
  flight.stops().holds(true).tick();
  EXPECT_EQ(flight.goal(1.0, 2.0).tick(), "HELD 3 hold");
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted"));
  EXPECT_EQ(flight.holds(false).tick(), "RUNNING 4 go to (1.00, 2.00)");
}

TEST(OperatorCommand, ResumesAGoalAfterAHold) {
  Flight flight = waiting();
  flight.goal(1.0, 2.0).tick();
  EXPECT_EQ(flight.runs().holds(true).tick(), "HELD 4 hold");
  EXPECT_EQ(flight.stops().tick(), "HELD 5 hold");
  EXPECT_EQ(flight.holds(false).tick(), "RUNNING 6 go to (1.00, 2.00)");
}

TEST(OperatorCommand, HasNoGoalAnyMoreOnceItIsHalted) {
  Flight flight = waiting();
  flight.goal(1.0, 2.0).tick();
  EXPECT_TRUE(flight.mission.waitingCommand());
  flight.runs();
  (void)flight.mission.letGo(flight.context);
  EXPECT_FALSE(flight.mission.waitingCommand());
}

TEST(OperatorCommand, ReleasesTheVehicleAtOnceWhenItHoldsAlready) {
  Flight flight = waiting();
  EXPECT_EQ(flight.stops().holds(true).tick(), "HELD 3 hold");
}

TEST(OperatorCommand, FliesToAGoalGivenDuringTakeOffAfterwards) {
  Flight flight(kOperator);
  flight.goal(1.0, 2.0).tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 accepted"));
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 2 go to (1.00, 2.00)");
}

TEST(Commands, AreAcceptedWhereTheMissionHasAnOperatorCommand) { EXPECT_TRUE(waiting().mission.acceptsGoals()); }

TEST(Commands, AreRefusedWhenTheMissionHasEnded) {
  Flight flight("<Timeout msec='1'><OperatorCommand/></Timeout>");
  flight.tick();
  EXPECT_EQ(flight.stops().tick(), "FAILED");
  flight.goal(1.0, 2.0).tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 refused: the mission has ended"));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
