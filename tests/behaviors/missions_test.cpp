// The shipped missions, and what `check` says of missions.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kMissions = std::string(SWIFTLET_SOURCE_DIR) + "/missions/";

std::vector<std::string> problemsOf(const std::string& inside, const MissionLimits& limits = {}) {
  const std::string text = "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n<BehaviorTree ID=\"M\">\n" + inside +
                           "\n</BehaviorTree></root>";
  std::vector<std::string> lines;
  for (const common::Problem& problem : checkMissionText(text, "m.xml", limits)) lines.push_back(toString(problem));
  return lines;
}

std::function<std::vector<std::string>(double)> notBelow(double least_m) {
  return [least_m](double clearance_m) {
    return clearance_m < least_m ? std::vector<std::string>{"it retreats"} : std::vector<std::string>{};
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
  try {
    Mission::fromText(
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><Takeoff/><Land "
        "now=\"1\"/></Sequence></BehaviorTree></root>",
        "m.xml");
    FAIL();
  } catch (const common::InputError& error) {
    ASSERT_EQ(error.problems().size(), 2U);
    EXPECT_EQ(toString(error.problems()[0]),
              "m.xml:1:55: Takeoff: unknown node `Takeoff`, did you mean `TakeOff`? [M/Sequence/Takeoff]");
    EXPECT_EQ(toString(error.problems()[1]),
              "m.xml:1:71: Land: unknown port `now`, expected no ports [M/Sequence/Land]");
  }
  EXPECT_THROW(Mission::fromFile("/nonexistent.xml"), common::InputError);
}

TEST(Check, AMissionThatNeverTakesOffIsAProblem) {
  EXPECT_THAT(problemsOf("<Hold/>"),
              ElementsAre("m.xml:3:1: M: the mission never takes off, expected a TakeOff [M/Hold]"));
  EXPECT_THAT(problemsOf("<Sequence>\n<Explore/>\n<TakeOff/></Sequence>"),
              ElementsAre("m.xml:4:1: Explore: the vehicle stands on the floor here, expected a TakeOff before it "
                          "[M/Sequence/Explore]"));
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Land/>\n<GoHome/></Sequence>"),
              ElementsAre(HasSubstr("m.xml:4:1: GoHome: the vehicle stands on the floor")));
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
              ElementsAre("m.xml:4:10: Explore.clearance_m: 0.15 m cannot be flown with this system: it retreats, "
                          "raise it, or change that distance in the system profile [M/Sequence/Explore]"));
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<Explore/></Sequence>", limits),
              ElementsAre(HasSubstr("m.xml:4:1: Explore.clearance_m: 0.1 m cannot be flown")))
      << "defaults count";
  EXPECT_THAT(problemsOf("<Sequence><SetBlackboard value=\"0.05\" output_key=\"c\"/><TakeOff/><Explore "
                         "clearance_m=\"{c}\"/></Sequence>",
                         limits),
              ElementsAre(HasSubstr("0.05 m cannot be flown")))
      << "entries count";
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Explore clearance_m=\"0.2\"/></Sequence>", limits), ElementsAre());
}

TEST(Check, BoundsThatAreNotARectangleAreAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<Explore bounds=\"4;0;-2;3\"/></Sequence>"),
              ElementsAre("m.xml:4:10: Explore.bounds: `4;0;-2;3` is not a rectangle `x_min;y_min;x_max;y_max` in "
                          "metres, each minimum below its maximum [M/Sequence/Explore]"));
  EXPECT_EQ(problemsOf("<Sequence><TakeOff/><Explore bounds=\"0;0;3\"/></Sequence>").size(), 1U);
  EXPECT_EQ(problemsOf("<Sequence><TakeOff/><Explore bound=\"0;0;3;3\"/></Sequence>").size(), 1U);
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><Explore bounds=\"-2;0;4;3\"/></Sequence>"), ElementsAre());
  EXPECT_THAT(problemsOf("<Sequence><SetBlackboard value=\"1;2\" output_key=\"room\"/><TakeOff/><Explore "
                         "bounds=\"{room}\"/></Sequence>"),
              ElementsAre(HasSubstr("(read by Explore.bounds from {room})")))
      << "entries count";
}

TEST(Check, AHeightAboveTheGreatestIsAProblem) {
  EXPECT_THAT(
      problemsOf("<Sequence><TakeOff height_m=\"4\"/><MoveToGoal goal=\"1;2;9\"/></Sequence>", {.max_height_m = 3.0}),
      ElementsAre(HasSubstr("TakeOff.height_m: 4 m is above the greatest height, 3 m"),
                  HasSubstr("MoveToGoal.goal: 9 m is above the greatest height, 3 m")));
}

TEST(Check, AHeightBelowTheLeastIsAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><MoveToGoal goal=\"1;2;0.1\"/></Sequence>"),
              ElementsAre(HasSubstr("MoveToGoal.goal: 0.1 m is below the least height, 0.3 m")));
}

TEST(Check, AGoalBeyondEveryMapIsAProblem) {
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/><MoveToGoal goal=\"1e9;2\"/></Sequence>"),
              ElementsAre(HasSubstr("MoveToGoal.goal: the goal is not a point of the map")));
}

TEST(Check, AChildThatIsNeverSkippedStarvesTheChildrenBelow) {
  EXPECT_THAT(
      problemsOf(
          "<Priority>\n<Sequence><TakeOff/><Land/></Sequence>\n<Sequence><TakeOff/><Land/></Sequence></Priority>"),
      ElementsAre(HasSubstr("m.xml:4:1: Sequence: never answers SKIPPED")));
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
  EXPECT_THAT(above("<Delay delay_msec=\"5\"><Hold/></Delay>"), ElementsAre(HasSubstr("Delay: never answers SKIPPED")));
  EXPECT_THAT(above("<Precondition if=\"rounds == 1\"><TurnTo yaw_deg=\"90\"/></Precondition>"),
              ElementsAre(HasSubstr("Precondition: never answers SKIPPED")));
  EXPECT_THAT(above("<RunOnce then_skip=\"false\"><TurnTo yaw_deg=\"90\"/></RunOnce>"),
              ElementsAre(HasSubstr("RunOnce: never answers SKIPPED")));
}

TEST(Check, AConditionDoesNotLiftAVehicleOffTheFloor) {
  EXPECT_THAT(problemsOf("<Sequence><MoveToGoal goal=\"1;0\" _skipIf=\"false\"/><TakeOff/><Land/></Sequence>"),
              ElementsAre(HasSubstr("MoveToGoal: the vehicle stands on the floor here")));
}

TEST(Check, ARoundThatIsRepeatedBeginsWhereTheLastOneEnded) {
  const auto repeated = [](const std::string& decorator) {
    return problemsOf("<Sequence><TakeOff/><" + decorator +
                      "><Sequence><MoveToGoal goal=\"1;0\"/><Land/></Sequence></" +
                      decorator.substr(0, decorator.find(' ')) + "></Sequence>");
  };
  for (const char* decorator : {"Repeat num_cycles=\"2\"", "LoopInt queue=\"1;2\"", "KeepRunningUntilFailure"})
    EXPECT_THAT(repeated(decorator),
                ElementsAre(HasSubstr("MoveToGoal: the vehicle stands on the floor when this is repeated"),
                            HasSubstr("Land: the vehicle stands on the floor")))
        << decorator;
  EXPECT_THAT(repeated("Repeat num_cycles=\"1\""), IsEmpty());
  EXPECT_THAT(repeated("RetryUntilSuccessful num_attempts=\"2\""), IsEmpty()) << "it lands only when it succeeds";
  EXPECT_THAT(problemsOf("<Repeat num_cycles=\"2\"><Sequence><TakeOff/><GoHome/><Land/></Sequence></Repeat>"),
              IsEmpty());
}

TEST(Survey, OfAnAreaThatNoFlightCoversIsRefused) {
  const auto problems =
      checkMissionText(R"(<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence><TakeOff/>)"
                       R"(<Survey polygon="0;0 | 50000;0 | 50000;50000"/><Land/></Sequence></BehaviorTree></root>)",
                       "m.xml");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(toString(problems[0]),
              HasSubstr("Survey.polygon: is 70711 m from corner to corner, more than the 300 m"));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
