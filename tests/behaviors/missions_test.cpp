// The shipped missions, and what `check` says of missions.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using test_support::ProblemIs;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kMissions = std::string(SWIFTLET_SOURCE_DIR) + "/missions/";

std::function<std::vector<common::Problem>(double)> notBelow(double least_m) {
  return [least_m](double clearance_m) {
    std::vector<common::Problem> problems;
    if (clearance_m < least_m) problems.push_back({{}, "", common::Message("test.retreats", "it retreats"), ""});
    return problems;
  };
}

TEST(ShippedMissions, AreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kMissions)) {
    if (entry.path().extension() != ".xml") continue;
    ++count;
    for (const common::Problem& problem :
         checkMission(entry.path().string(), {.clearance_problems = notBelow(0.10), .max_height_m = 3.0}))
      ADD_FAILURE() << toString(problem);
  }
  EXPECT_GE(count, 2);
}

TEST(ExploreAndReturn, FliesFigure5) {
  Flight flight(Mission::fromFile(kMissions + "explore_and_return.xml"));
  EXPECT_EQ(flight.mission.name(), "ExploreAndReturn");
  EXPECT_FALSE(flight.mission.acceptsGoals());
  EXPECT_EQ(flight.tick(), "RUNNING 1 take off to 1.00 m");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 2 explore");
  EXPECT_THAT(flight.succeeds().tick(), HasSubstr("RUNNING 3 go to ("));
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 4 go to (0.00, 0.00)");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 5 land");
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(OperatorGoals, TakesOffAndWaits) {
  Flight flight(Mission::fromFile(kMissions + "operator_goals.xml"));
  EXPECT_TRUE(flight.mission.acceptsGoals());
  flight.tick();
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.goal(1.0, 1.0).tick(), "RUNNING 3 go to (1.00, 1.00)");
}

TEST(FromFile, ThrowsEveryProblem) {
  const std::string text =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><Takeoff/><Land "
      "now=\"1\"/></Sequence></BehaviorTree></root>";
  EXPECT_THAT(
      test_support::problemsOf([&] { Mission::fromText(text, "m.xml"); }),
      ElementsAre(ProblemIs("tree.unknown-node", "m.xml:1:55: Takeoff", "did you mean `TakeOff`? [M/Sequence/Takeoff]"),
                  ProblemIs("tree.unknown-port", "m.xml:1:71: Land", "[M/Sequence/Land]")));
  EXPECT_THROW(Mission::fromFile("/nonexistent.xml"), common::InputError);
}

TEST(Check, AProblemOfAnotherRoomKeepsItsName) {
  const common::Problem problem{
      {"s.yaml", 2}, "based_on", common::Message("profile.circle", "{} is based on itself", "a"), "h"};
  const tree::Problem shown = toTree(problem);
  EXPECT_EQ(shown.message.name(), "profile.circle");
  EXPECT_THAT(toCommon({shown}),
              ElementsAre(ProblemIs("profile.circle", "s.yaml:2: based_on", "a is based on itself, h")));
}

TEST(Check, AMissionThatNeverTakesOffIsAProblem) {
  EXPECT_THAT(problemsOf("<Hold/>"), ElementsAre(At("3:1 M", "mission.no-take-off", "[M/Hold]")));
  EXPECT_THAT(problemsOf("<Sequence>\n<Explore/>\n<TakeOff/></Sequence>"),
              ElementsAre(At("4:1 Explore", "mission.on-the-floor", "[M/Sequence/Explore]")));
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Land/>\n<GoHome/></Sequence>"),
              ElementsAre(At("4:1 GoHome", "mission.on-the-floor")));
}

TEST(Check, FollowsWhereTheVehicleMayBeInEveryBranch) {
  constexpr const char* kExploresForAWhile =
      "<Sequence><TakeOff/><Fallback><Timeout msec='5'><Explore/></Timeout><AlwaysSuccess/></Fallback>"
      "<Land/></Sequence>";
  for (const char* sound :
       {"<Sequence><TakeOff/><Land/><TakeOff/><Land/></Sequence>",
        "<Fallback><Sequence><TakeOff/><Explore/><Land/></Sequence><Sequence><GoHome/><Land/></Sequence></Fallback>",
        "<Sequence><ForceSuccess><TakeOff/></ForceSuccess><Explore/></Sequence>",
        "<Sequence><TakeOff/><Timeout msec='5'><Explore/></Timeout><Land/></Sequence>", kExploresForAWhile,
        "<Repeat num_cycles='2'><Sequence><TakeOff/><Land/></Sequence></Repeat>",
        "<Priority><AvoidObstacle/><Hold/><Sequence><TakeOff/><Land/></Sequence></Priority>",
        "<Parallel><TakeOff/><Hold/></Parallel>"})
    EXPECT_THAT(problemsOf(sound), ElementsAre()) << sound;
  for (const char* wrong :
       {"<Fallback><TakeOff/><AlwaysSuccess/></Fallback>", "<Sequence><AlwaysFailure/><TakeOff/><Explore/></Sequence>",
        "<Fallback><AlwaysSuccess/><Sequence><TakeOff/><Explore/></Sequence></Fallback>"})
    EXPECT_LE(problemsOf(wrong).size(), 1U) << wrong;
  EXPECT_EQ(problemsOf("<Sequence><Inverter><TakeOff/></Inverter><Land/></Sequence>").size(), 0U);
}

TEST(Check, AClearanceBelowTheReactiveMarginIsAProblem) {
  const MissionLimits limits{.clearance_problems = notBelow(0.2), .max_height_m = 3.0};
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<Explore clearance_m=\"0.15\"/></Sequence>", limits),
              ElementsAre(At("4:10 Explore.clearance_m", "mission.clearance", "it retreats", "[M/Sequence/Explore]")));
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<Explore/></Sequence>", limits),
              ElementsAre(At("4:1 Explore.clearance_m", "mission.clearance")))
      << "defaults count";
  EXPECT_THAT(problemsOf("<Sequence><SetBlackboard value=\"0.05\" output_key=\"c\"/><TakeOff/><Explore "
                         "clearance_m=\"{c}\"/></Sequence>",
                         limits),
              ElementsAre(At("3:74 Explore.clearance_m", "mission.clearance", "0.05 m")))
      << "entries count";
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Explore clearance_m=\"0.2\"/></Sequence>", limits), ElementsAre());
}

TEST(Check, BoundsThatAreNotARectangleAreAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<Explore bounds=\"4;0;-2;3\"/></Sequence>"),
              ElementsAre(At("4:10 Explore.bounds", "tree.value-type", "`4;0;-2;3`", "[M/Sequence/Explore]")));
  EXPECT_EQ(problemsOf("<Sequence><TakeOff/><Explore bounds=\"0;0;3\"/></Sequence>").size(), 1U);
  EXPECT_EQ(problemsOf("<Sequence><TakeOff/><Explore bound=\"0;0;3;3\"/></Sequence>").size(), 1U);
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Explore bounds=\"-2;0;4;3\"/></Sequence>"), ElementsAre());
  EXPECT_THAT(problemsOf("<Sequence><SetBlackboard value=\"1;2\" output_key=\"room\"/><TakeOff/><Explore "
                         "bounds=\"{room}\"/></Sequence>"),
              ElementsAre(At("3:26 value", "tree.value-type", "`1;2`", "Explore.bounds", "{room}")))
      << "entries count";
}

TEST(Check, AHeightAboveTheGreatestIsAProblem) {
  EXPECT_THAT(
      problemsOf("<Sequence><TakeOff height_m=\"4\"/><MoveToGoal goal=\"1;2;9\"/></Sequence>", {.max_height_m = 3.0}),
      ElementsAre(At("3:20 TakeOff.height_m", "mission.goal-refused", "4 m", "3 m"),
                  At("3:46 MoveToGoal.goal", "mission.goal-refused", "9 m", "3 m")));
}

TEST(Check, AHeightBelowTheLeastIsAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><MoveToGoal goal=\"1;2;0.1\"/></Sequence>"),
              ElementsAre(At("3:33 MoveToGoal.goal", "mission.goal-refused", "0.1 m", "0.3 m")));
}

TEST(Check, AGoalBeyondEveryMapIsAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><MoveToGoal goal=\"1e9;2\"/></Sequence>"),
              ElementsAre(At("3:33 MoveToGoal.goal", "mission.goal-refused")));
}

TEST(Check, AChildThatIsNeverSkippedStarvesTheChildrenBelow) {
  EXPECT_THAT(
      problemsOf(
          "<Priority>\n<Sequence><TakeOff/><Land/></Sequence>\n<Sequence><TakeOff/><Land/></Sequence></Priority>"),
      ElementsAre(At("4:1 Sequence", "mission.never-skipped")));
}

TEST(Check, AChildMayStandAboveOthersWhereItsConditionSkipsIt) {
  const auto above = [](const std::string& child) {
    return problemsOf("<Sequence><TakeOff/><Script code=\"rounds := 0\"/><Priority>" + child +
                      "<Patrol points=\"1;0 | 2;0\"/></Priority><Land/></Sequence>");
  };
  EXPECT_THAT(above("<TurnTo yaw_deg=\"90\" _skipIf=\"rounds == 0\"/>"), IsEmpty());
  EXPECT_THAT(above("<TurnTo yaw_deg=\"90\" _while=\"rounds == 1\"/>"), IsEmpty());
  EXPECT_THAT(above("<RunOnce><TurnTo yaw_deg=\"90\"/></RunOnce>"), IsEmpty());
  EXPECT_THAT(above("<Precondition if=\"rounds == 1\" else=\"SKIPPED\"><TurnTo yaw_deg=\"90\"/></Precondition>"),
              IsEmpty());
  EXPECT_THAT(above("<LoopInt queue=\"1;2\" if_empty=\"SKIPPED\"><TurnTo yaw_deg=\"90\"/></LoopInt>"), IsEmpty());
  EXPECT_THAT(above("<IfThenElse><Hold/><TurnTo yaw_deg=\"90\"/></IfThenElse>"), IsEmpty());
  EXPECT_THAT(above("<Delay delay_msec=\"5\"><Hold/></Delay>"), ElementsAre(At("3:59 Delay", "mission.never-skipped")));
  EXPECT_THAT(above("<Precondition if=\"rounds == 1\"><TurnTo yaw_deg=\"90\"/></Precondition>"),
              ElementsAre(At("3:59 Precondition", "mission.never-skipped")));
  EXPECT_THAT(above("<RunOnce then_skip=\"false\"><TurnTo yaw_deg=\"90\"/></RunOnce>"),
              ElementsAre(At("3:59 RunOnce", "mission.never-skipped")));
}

TEST(Check, AConditionDoesNotLiftAVehicleOffTheFloor) {
  EXPECT_THAT(problemsOf("<Sequence><MoveToGoal goal=\"1;0\" _skipIf=\"false\"/><TakeOff/><Land/></Sequence>"),
              ElementsAre(At("3:11 MoveToGoal", "mission.on-the-floor")));
}

TEST(Check, ARoundThatIsRepeatedBeginsWhereTheLastOneEnded) {
  const auto repeated = [](const std::string& decorator) {
    return problemsOf("<Sequence><TakeOff/><" + decorator +
                      ">\n<Sequence><MoveToGoal goal=\"1;0\"/><Land/></Sequence></" +
                      decorator.substr(0, decorator.find(' ')) + "></Sequence>");
  };
  for (const char* decorator : {"Repeat num_cycles=\"2\"", "LoopInt queue=\"1;2\"", "KeepRunningUntilFailure"})
    EXPECT_THAT(repeated(decorator),
                ElementsAre(At("4:11 MoveToGoal", "mission.on-the-floor"), At("4:35 Land", "mission.on-the-floor")))
        << decorator;
  EXPECT_THAT(repeated("Repeat num_cycles=\"1\""), IsEmpty());
  EXPECT_THAT(repeated("RetryUntilSuccessful num_attempts=\"2\""), IsEmpty()) << "it lands only when it succeeds";
  EXPECT_THAT(problemsOf("<Repeat num_cycles=\"2\"><Sequence><TakeOff/><GoHome/><Land/></Sequence></Repeat>"),
              IsEmpty());
}

TEST(Survey, OfAnAreaThatNoFlightCoversIsRefused) {
  EXPECT_THAT(problemsInside(R"(<TakeOff/><Survey polygon="0;0 | 50000;0 | 50000;50000"/><Land/>)"),
              ElementsAre(At("3:29 Survey.polygon", "mission.survey-large", "70711 m", "300 m")));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
