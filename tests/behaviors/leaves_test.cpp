// The behaviours, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(TakeOff, KeepsOneIntentUntilItIsDone) {
  Flight flight(R"(<TakeOff height_m="1.5"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 take off to 1.50 m");
  EXPECT_EQ(flight.tick(), "RUNNING 1 take off to 1.50 m") << "nobody has answered yet";
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 take off to 1.50 m");
  EXPECT_EQ(flight.last.phase, "take off to 1.50 m");
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
  EXPECT_EQ(flight.tick(), "DONE") << "an ended mission stays ended";
  EXPECT_THAT(flight.events(), ElementsAre("TakeOff starts", "TakeOff is done"));
}

TEST(TakeOff, ItsFailureEndsTheMissionWithTheReason) {
  Flight flight("<Sequence><TakeOff/><Land/></Sequence>");
  EXPECT_EQ(flight.tick(), "RUNNING 1 take off to 1.00 m");
  EXPECT_EQ(flight.fails("the battery is empty").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "TakeOff: the battery is empty");
  EXPECT_THAT(flight.events(), ElementsAre("TakeOff starts", "TakeOff failed (the battery is empty)"));
}

TEST(Leaves, IgnoreAnswersToAnOlderIntent) {
  Flight flight("<Sequence><TakeOff/><Land/></Sequence>");
  flight.tick();
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 2 land");
  EXPECT_EQ(flight.tick(), "RUNNING 2 land") << "the status still says that intent 1 succeeded";
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(Explore, PassesOnItsClearance) {
  Flight flight(R"(<Explore clearance_m="0.25"/>)");
  flight.tick();
  EXPECT_DOUBLE_EQ(std::get<common::ExploreIntent>(flight.context.intent->kind).clearance_m, 0.25);
}

TEST(Explore, PassesOnItsBoundsIfItHasSome) {
  Flight free("<Explore/>");
  free.tick();
  EXPECT_FALSE(std::get<common::ExploreIntent>(free.context.intent->kind).bounds);
  Flight flight(R"(<Explore bounds="-2; -1.5;4;5"/>)");
  flight.tick();
  const auto bounds = std::get<common::ExploreIntent>(flight.context.intent->kind).bounds;
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->min_named_m, Eigen::Vector2d(-2, -1.5));
  EXPECT_EQ(bounds->max_named_m, Eigen::Vector2d(4, 5));
}

/// 30 m2 are explored, and a frontier of that length is left.
void leaveFrontier(Flight& flight, double length_m, common::FrontierReason reason) {
  flight.change([&](test::Layers& layers) {
    layers.map.explored_area_m2 = 30.0;
    std::vector<common::Frontier> frontiers(1);
    frontiers.front().length_m = length_m;
    frontiers.front().reason = reason;
    layers.map.frontiers = std::make_shared<const std::vector<common::Frontier>>(frontiers);
  });
}

TEST(Explore, FailsIfTooSmallAShareOfTheFreeSpaceIsExplored) {
  Flight flight(R"(<Explore coverage_min="0.9"/>)");
  flight.tick();
  leaveFrontier(flight, 5.0, common::FrontierReason::kUnreachable);
  flight.succeeds().tick();
  EXPECT_EQ(flight.last.state, common::MissionState::kFailed);
  EXPECT_THAT(flight.cause(), HasSubstr("incomplete, 75 % of the free space are explored and 90 % asked for"));
}

TEST(Explore, IsDoneWithTheCoverageThatIsAskedFor) {
  const auto ends = [](const char* ports, double length_m, common::FrontierReason reason) {
    Flight flight(std::string("<Explore ") + ports + "/>");
    flight.tick();
    leaveFrontier(flight, length_m, reason);
    return flight.succeeds().tick();
  };
  EXPECT_EQ(ends(R"(coverage_min="0.9")", 1.5, common::FrontierReason::kUnreachable), "DONE") << "30 of 33 m2";
  EXPECT_EQ(ends(R"(coverage_min="0.9")", 5.0, common::FrontierReason::kOutOfBounds), "DONE") << "not to be explored";
  EXPECT_EQ(ends("", 5.0, common::FrontierReason::kUnreachable), "DONE") << "none is asked for";
}

TEST(Localize, ExploresUntilTheVehicleIsLocalized) {
  Flight flight(R"(<Sequence><Localize clearance_m="0.25"/><Land/></Sequence>)");
  flight.localization(common::LocalizationState::kGlobal);
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore");
  EXPECT_DOUBLE_EQ(std::get<common::ExploreIntent>(flight.context.intent->kind).clearance_m, 0.25);
  EXPECT_EQ(flight.runs().localization(common::LocalizationState::kAmbiguous).tick(), "RUNNING 1 explore");
  EXPECT_EQ(flight.localization(common::LocalizationState::kLocalized).tick(), "RUNNING 2 land");
}

TEST(Localize, FailsWithoutAMapOrWithNothingLeftToExplore) {
  Flight without("<Localize/>");
  EXPECT_EQ(without.tick(), "FAILED");
  EXPECT_EQ(without.cause(), "Localize: the flight was given no map");
  Flight flight("<Localize/>");
  flight.localization(common::LocalizationState::kAmbiguous).tick();
  EXPECT_EQ(flight.succeeds().tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "Localize: nothing is left to explore, and the place is still ambiguous");
}

TEST(Localize, FailsInTheMapOfAnotherPlace) {
  Flight flight("<Localize/>");
  flight.localization(common::LocalizationState::kGlobal).tick();
  flight.runs().change([](auto& layers) { layers.map.localization->refuted = true; });
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "Localize: the given map does not match this place");
}

TEST(MoveToGoal, ItsGoalIsInTheMapThatWasGiven) {
  Flight flight(R"(<MoveToGoal goal="3.0;-1.0" yaw_deg="10"/>)");
  const auto placed = [&](double x_m) {
    flight.localization(common::LocalizationState::kLocalized).change([x_m](auto& layers) {
      layers.map.T_map_given = common::Pose2{x_m, 2.0, 90.0 * common::kRadPerDeg};
    });
  };
  const auto goal_map_m = [&] { return std::get<common::GoToIntent>(flight.context.intent->kind).goal_map_m; };
  placed(1.0);
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (3.00, -1.00) in the given map");
  EXPECT_TRUE(goal_map_m().isApprox(Eigen::Vector2d(2.0, 5.0)));
  EXPECT_NEAR(*std::get<common::GoToIntent>(flight.context.intent->kind).yaw_map_rad, 100.0 * common::kRadPerDeg, 1e-9);
  placed(1.02);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 go to (3.00, -1.00) in the given map") << "a centimetre is no news";
  placed(1.05);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 go to (3.00, -1.00) in the given map");
  EXPECT_NEAR(goal_map_m().x(), 2.05, 1e-9);
  flight.localization(common::LocalizationState::kLost).change([](auto& layers) { layers.map.T_map_given.reset(); });
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "MoveToGoal: its place in the given map is not known");
}

TEST(MoveToGoal, PassesOnGoalHeightAndTolerance) {
  Flight flight(R"(<MoveToGoal goal="3.0;-1.5;1.2" tolerance_m="0.2" clearance_m="0.3"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (3.00, -1.50)");
  const auto intent = std::get<common::GoToIntent>(flight.context.intent->kind);
  EXPECT_EQ(intent.height_m, 1.2);
  EXPECT_EQ(intent.tolerance_m, 0.2);
  EXPECT_EQ(intent.clearance_m, 0.3);
  EXPECT_FALSE(intent.yaw_map_rad);
}

TEST(MoveToGoal, KeepsTheHeightWithoutZ) {
  Flight flight(R"(<MoveToGoal goal="3.0;-1.5"/>)");
  flight.tick();
  EXPECT_FALSE(std::get<common::GoToIntent>(flight.context.intent->kind).height_m);
}

TEST(MoveToGoal, FailsForAHeightOutsideTheLimits) {
  for (const auto& [goal, reason] : {std::pair("1;2;9", "MoveToGoal: 9 m is above the greatest height, 3 m"),
                                     std::pair("1;2;0.1", "MoveToGoal: 0.1 m is below the least height, 0.3 m")}) {
    Flight flight(std::string(R"(<Sequence><SetBlackboard value=")") + goal +
                  R"(" output_key="target"/><MoveToGoal goal="{target}"/></Sequence>)");
    flight.context.goal_limits.greatest_height_m = 3.0;
    EXPECT_EQ(flight.tick(), "FAILED");
    EXPECT_EQ(flight.cause(), reason);
  }
}

TEST(MoveToGoal, WaitsForTheMapBeforeItJudgesTheGoal) {
  Flight flight(R"(<MoveToGoal goal="4.05;0"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (4.05, 0.00)");
}

TEST(MoveToGoal, ReadsItsGoalFromABlackboardEntry) {
  Flight flight(
      R"(<Sequence><SetBlackboard value="1;2" output_key="target"/><MoveToGoal goal="{target}"/></Sequence>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (1.00, 2.00)");
}

TEST(GoHome, FollowsACorrectionOfHome) {
  Flight flight(R"(<GoHome tolerance_m="0.1"/>)");
  flight.home(0.0, 0.0);
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (0.00, 0.00)");
  EXPECT_EQ(flight.home(0.04, 0.0).tick(), "RUNNING 1 go to (0.00, 0.00)") << "well within the tolerance";
  EXPECT_EQ(flight.home(0.2, 0.1).tick(), "RUNNING 2 go to (0.20, 0.10)");
}

constexpr const char* kMission =
    R"(<Priority><AvoidObstacle/><Hold/><Sequence><TakeOff/><Explore/><Land/></Sequence></Priority>)";

/// A flight in the middle of Explore, which has intent 2.
Flight exploring() {
  Flight flight(kMission);
  flight.tick();
  flight.succeeds().tick();
  flight.runs().tick();
  flight.events();
  return flight;
}

TEST(Hold, TakesOverOnlyWhenTheVehicleHasStopped) {
  Flight flight = exploring();
  flight.holds(true, "the operator holds");
  EXPECT_EQ(flight.tick(), "HELD 3 hold") << "Explore asks to stop";
  EXPECT_EQ(flight.runs().tick(), "HELD 3 hold") << "not stopped yet";
  EXPECT_EQ(flight.stops().tick(), "HELD 4 hold") << "the Hold's own";
  EXPECT_EQ(flight.last.reason, "the operator holds");
  EXPECT_EQ(flight.view(),
            "Priority RUNNING, AvoidObstacle SKIPPED, Hold RUNNING, Sequence SUSPENDED, TakeOff SUCCESS, "
            "Explore SUSPENDED, Land IDLE");
  EXPECT_THAT(flight.events(), ElementsAre("Explore yields to Hold (the operator holds)",
                                           "Hold takes over from Explore (the operator holds)"));
  flight.holds(false);
  EXPECT_EQ(flight.stops().tick(), "RUNNING 5 explore") << "resumed in the same tick, as a new intent";
  EXPECT_THAT(flight.events(), ElementsAre("Explore resumes (Hold ended with SUCCESS)"));
}

TEST(Hold, ReleasedEarlyTheInterruptedBehaviourContinues) {
  Flight flight = exploring();
  flight.holds(true).tick();
  EXPECT_EQ(flight.runs().holds(false).tick(), "RUNNING 4 explore");
  EXPECT_THAT(flight.events(),
              ElementsAre("Explore yields to Hold (the operator holds)", "Explore continues (Hold no longer asks)"));
}

TEST(Hold, TheInterruptedIntentIsNamedByTheOneThatGoesOnWithIt) {
  Flight flight = exploring();
  EXPECT_EQ(flight.context.intent->resumes, 0U);
  flight.holds(true).tick();
  flight.stops().tick();
  EXPECT_EQ(flight.context.intent->resumes, 0U) << "the hold itself";
  EXPECT_EQ(flight.stops().holds(false).tick(), "RUNNING 5 explore");
  EXPECT_EQ(flight.context.intent->resumes, 2U);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 5 explore");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 6 land");
  EXPECT_EQ(flight.context.intent->resumes, 0U) << "another leaf";
}

TEST(Hold, WhatEndsInTheTickOfTheInterruptionHasEnded) {
  Flight flight = exploring();
  EXPECT_EQ(flight.succeeds().holds(true).tick(), "HELD 3 hold");
  flight.stops().tick();
  EXPECT_EQ(flight.stops().holds(false).tick(), "RUNNING 5 land") << "Explore was done";
  Flight failing = exploring();
  failing.fails("no map").holds(true).tick();
  failing.stops().tick();
  failing.stops().holds(false).tick();
  EXPECT_EQ(failing.cause(), "Explore: no map");
}

TEST(Hold, IgnoresAnswersForAnotherIntent) {
  Flight flight = exploring();
  flight.stops().holds(true);
  EXPECT_EQ(flight.tick(), "HELD 3 hold") << "released is about Explore's intent, not about the hold";
  EXPECT_EQ(flight.tick(), "HELD 3 hold");
}

TEST(Hold, ResumesAnInterruptedTakeOff) {
  Flight flight(kMission);
  flight.is(common::FlightState::kTakingOff);
  EXPECT_EQ(flight.tick(), "RUNNING 1 take off to 1.00 m");
  flight.runs().holds(true).tick();
  EXPECT_EQ(flight.stops().tick(), "HELD 3 hold");
  EXPECT_EQ(flight.holds(false).tick(), "RUNNING 4 take off to 1.00 m");
}

TEST(Hold, DelaysTheStartOfTheMission) {
  Flight flight(kMission);
  EXPECT_EQ(flight.holds(true).tick(), "HELD 1 hold");
  EXPECT_EQ(flight.holds(false).tick(), "RUNNING 2 take off to 1.00 m");
}

TEST(AvoidObstacle, ControlsTheVehicleWhileTheReactiveLayerRetreats) {
  Flight flight = exploring();
  flight.retreats(true, "0.31 m ahead, closing");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 4 avoid obstacle")
      << "the layer moves it already: nothing has to stop first";
  EXPECT_EQ(flight.runs().tick(), "RUNNING 4 avoid obstacle");
  EXPECT_THAT(flight.events(), ElementsAre("Explore yields to AvoidObstacle (0.31 m ahead, closing)",
                                           "AvoidObstacle takes over from Explore (0.31 m ahead, closing)"));
  EXPECT_EQ(flight.retreats(false).tick(), "RUNNING 5 explore");
  EXPECT_THAT(flight.events(), ElementsAre("Explore resumes (AvoidObstacle ended with SUCCESS)"));
}

TEST(AvoidObstacle, IsSkippedUnlessFlying) {
  for (const auto state :
       {common::FlightState::kLanded, common::FlightState::kTakingOff, common::FlightState::kLanding}) {
    Flight flight(kMission);
    EXPECT_EQ(flight.is(state).retreats(true).tick(), "RUNNING 1 take off to 1.00 m");
  }
}

TEST(AvoidObstacle, InterruptsAHold) {
  Flight flight = exploring();
  flight.holds(true).tick();
  flight.stops().tick();
  EXPECT_EQ(flight.retreats(true).tick(), "RUNNING 5 avoid obstacle");
  EXPECT_EQ(flight.view(),
            "Priority RUNNING, AvoidObstacle RUNNING, Hold SUSPENDED, Sequence SUSPENDED, TakeOff SUCCESS, "
            "Explore SUSPENDED, Land IDLE");
  EXPECT_EQ(flight.retreats(false).tick(), "HELD 6 hold");
  flight.events();
  flight.retreats(true).tick();
  EXPECT_EQ(flight.retreats(false).holds(false).tick(), "RUNNING 8 explore") << "the hold ended meanwhile";
}

TEST(Commands, AreRefusedWhereTheMissionHasNoOperatorCommand) {
  Flight flight = exploring();
  EXPECT_FALSE(flight.mission.acceptsGoals());
  flight.goal(1.0, 2.0).homeCommand().tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 refused: the mission M has no OperatorCommand: it flies its own goals",
                                            "2 refused: the mission M has no OperatorCommand: it flies its own goals"));
}

TEST(Mission, HaltsAndStartsFromTheBeginningAgain) {
  Flight flight = exploring();
  EXPECT_FALSE(flight.mission.letGo(flight.context));
  EXPECT_EQ(toString(*flight.context.intent), "hold");
  EXPECT_FALSE(flight.runs().mission.letGo(flight.context));
  EXPECT_TRUE(flight.stops().mission.letGo(flight.context));
  EXPECT_THAT(flight.events(), ElementsAre("Explore is cancelled"));
  EXPECT_EQ(flight.view(),
            "Priority IDLE, AvoidObstacle IDLE, Hold IDLE, Sequence IDLE, TakeOff IDLE, Explore IDLE, Land IDLE");
  EXPECT_EQ(flight.tick().substr(10), "take off to 1.00 m") << "it stands at its beginning";
}

TEST(Mission, GivesNoIntentWhenThereIsNothingToDo) {
  Flight flight("<Priority><AvoidObstacle/><Hold/></Priority>");
  EXPECT_EQ(flight.tick(), "RUNNING");
  EXPECT_EQ(flight.last.phase, "nothing to do");
}

TEST(Mission, ATimeoutStopsTheVehicleBeforeItFails) {
  Flight flight(R"(<Fallback><Timeout msec="250"><Explore/></Timeout><Land/></Fallback>)");
  flight.tick();
  flight.runs().tick();
  flight.runs().tick();
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 hold") << "300 ms have passed";
  EXPECT_EQ(flight.stops().tick(), "RUNNING 3 land");
  EXPECT_THAT(flight.events(), ElementsAre("Explore starts", "Explore is cancelled",
                                           "Timeout failed (timed out after 0.25 s)", "Land starts"));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
