// What `check` warns of: missions that can be flown, but are probably not meant so.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MissionVerdict verdictOn(const std::string& inside, const MissionLimits& limits = {}) {
  return judgeMissionText("<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n<BehaviorTree ID=\"M\">\n" + inside +
                              "\n</BehaviorTree></root>",
                          "m.xml", limits);
}

std::vector<std::string> linesOf(const std::vector<tree::Problem>& problems) {
  std::vector<std::string> lines;
  for (const tree::Problem& problem : problems) lines.push_back(toString(problem) + " [" + problem.path + "]");
  return lines;
}

std::vector<std::string> warningsOf(const std::string& inside) {
  const MissionVerdict verdict = verdictOn(inside);
  EXPECT_THAT(linesOf(verdict.problems), IsEmpty()) << inside;
  return linesOf(verdict.warnings);
}

TEST(Warnings, NameNodesThatAreNeverReached) {
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<Fallback><AlwaysSuccess/><GoHome/></Fallback><Land/></Sequence>"),
              ElementsAre("m.xml:4:27: GoHome: is never reached: `AlwaysSuccess` before it never fails "
                          "[M/Sequence/Fallback/GoHome]"));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<Patrol points=\"1;1|2;2\" rounds=\"0\"/><Land/></Sequence>"),
              ElementsAre(HasSubstr("4:38: Land: is never reached: `Patrol` before it never succeeds"),
                          HasSubstr("3:1: Sequence: the mission never lands")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<OperatorCommand/><Land/></Sequence>"),
              ElementsAre(HasSubstr("Land: is never reached: `OperatorCommand` before it never succeeds")));
}

TEST(Warnings, NameWhatWaitsForAnOperatorWhoIsNotThere) {
  const std::string inside =
      "<Sequence><TakeOff/>\n<WaitForOperator/><WaitForOperator timeout_s=\"30\"/><LogEvent text=\"a\"/>"
      "<OperatorCommand/></Sequence>";
  EXPECT_THAT(warningsOf(inside), IsEmpty());
  MissionLimits limits;
  limits.operator_goes_on = limits.operator_gives_goals = false;
  EXPECT_THAT(
      linesOf(verdictOn(inside, limits).warnings),
      ElementsAre(HasSubstr("4:1: WaitForOperator: nobody says `go on`, and it waits without an end, fly with the "
                            "page, or give the trial an `operator` script [M/Sequence/WaitForOperator[1]]"),
                  HasSubstr("nobody says `go on`, and it fails after its timeout_s"),
                  HasSubstr("OperatorCommand: nobody gives it a goal, and the vehicle holds here")));
  const auto onWaiterIn = [&](const std::string& begin, const std::string& end) {
    return linesOf(
        verdictOn("<Sequence><TakeOff/>" + begin + "<WaitForOperator/>" + end + "<Land/></Sequence>", limits).warnings);
  };
  EXPECT_THAT(onWaiterIn("<Timeout msec=\"9000\">", "</Timeout>"),
              ElementsAre(HasSubstr("it waits until the Timeout above it ends it")));
  EXPECT_THAT(onWaiterIn("<Timeout msec=\"0\">", "</Timeout>"), ElementsAre(HasSubstr("it waits without an end")));
  EXPECT_THAT(onWaiterIn("<ReactiveSequence><AlwaysSuccess/>", "</ReactiveSequence>"),
              ElementsAre(HasSubstr("it waits until something else ends it")));
  limits.operator_gives_goals = true;
  EXPECT_THAT(linesOf(verdictOn(inside, limits).warnings).size(), 2U);
  EXPECT_THAT(linesOf(verdictOn("<Sequence><TakeOff/><Land/><Fallback><AlwaysSuccess/><WaitForOperator/></Fallback>"
                                "</Sequence>",
                                limits)
                          .warnings),
              ElementsAre(HasSubstr("is never reached")))
      << "what is never reached waits for nobody";
}

TEST(Warnings, AgreeWithTheOrderOfFlightOnWhatCannotFail) {
  for (const char* leaf : {"<SetFlightMode mode=\"fast\"/>", "<LogEvent text=\"a\"/>", "<Sleep msec=\"5\"/>"})
    EXPECT_THAT(
        warningsOf("<Sequence><TakeOff/><Fallback>" + std::string(leaf) + "<Land/></Fallback><Land/></Sequence>"),
        ElementsAre(HasSubstr("Land: is never reached")))
        << leaf;
}

TEST(Warnings, NameAParallelOfTwoThatFly) {
  EXPECT_THAT(
      warningsOf("<Sequence><TakeOff/>\n<Parallel><MoveToGoal goal=\"1;1\"/><Sequence><LogEvent text=\"a\"/><Explore "
                 "name=\"look\"/></Sequence></Parallel><Land/></Sequence>"),
      ElementsAre("m.xml:4:1: Parallel: `MoveToGoal` and `look` fly in the same tick, and only the last intent is "
                  "flown, let one child fly and the others watch [M/Sequence/Parallel]"));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><ParallelAll><Explore/><Sequence><IsLost/><LogEvent text=\"a\"/>"
                         "</Sequence><Hold/></ParallelAll><Land/></Sequence>"),
              IsEmpty());
}

TEST(Warnings, NameAMissionThatNeverLands) {
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><GoHome/></Sequence>"),
              ElementsAre("m.xml:3:1: Sequence: the mission never lands, end it with a <Land/> [M/Sequence]"));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><ForceSuccess><Explore/></ForceSuccess><Land/></Sequence>"), IsEmpty());
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><OperatorCommand/></Sequence>"), IsEmpty()) << "the operator lands";
}

TEST(Warnings, NameAMissionThatMaySucceedInTheAir) {
  for (const char* inside : {"<TakeOff/><Fallback><Explore/><Land/></Fallback>", "<TakeOff/><Land/><TakeOff/>",
                             "<TakeOff/><GoHome/><Land _skipIf=\"@tired == 1\" _onSuccess=\"@tired := 1\"/>",
                             "<TakeOff/><Land _successIf=\"@n == 1\" _onFailure=\"@n := 1\"/>",
                             "<TakeOff/><IfThenElse><IsLost/><Land/><GoHome/></IfThenElse>",
                             "<TakeOff/><Switch2 variable=\"{m}\" case_1=\"1\" case_2=\"2\" _onSuccess=\"m := 1\">"
                             "<Land/><Land/><GoHome/></Switch2>"})
    EXPECT_THAT(warningsOf("<Sequence>" + std::string(inside) + "</Sequence>"),
                ElementsAre("m.xml:3:1: Sequence: the mission may succeed while the vehicle is in the air, end it with "
                            "a <Land/> [M/Sequence]"))
        << inside;
  for (const char* inside :
       {"<TakeOff/><IfThenElse><IsLost/><EmergencyLand/><Sequence><GoHome/><Land/></Sequence></IfThenElse>",
        "<TakeOff/><Timeout msec=\"9\"><FollowMe/></Timeout>", "<TakeOff/><Delay delay_msec=\"5\"><Land/></Delay>",
        "<TakeOff/><Switch2 variable=\"{m}\" case_1=\"1\" case_2=\"2\" _onSuccess=\"m := 1\"><Land/><Land/><Land/>"
        "</Switch2>",
        "<TakeOff/><WhileDoElse><IsLost/><Land/><Land/></WhileDoElse>",
        "<TakeOff/><Repeat num_cycles=\"-1\"><Patrol points=\"1;1|2;2\"/></Repeat>"})
    EXPECT_THAT(warningsOf("<Fallback><Sequence>" + std::string(inside) + "</Sequence><Land/></Fallback>"), IsEmpty())
        << inside;
}

TEST(Warnings, NameWhatTheFileExcludes) {
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><GoHome/>\n<Land _skipIf=\"true\"/></Sequence>"),
              ElementsAre(HasSubstr("4:1: Land: is never reached: its `_skipIf` is always true"),
                          HasSubstr("the mission never lands")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><FollowMe/>\n<GoHome/><Land/></Sequence>"),
              ElementsAre(HasSubstr("GoHome: is never reached: `FollowMe` before it never succeeds"),
                          HasSubstr("Land: is never reached"), HasSubstr("the mission never lands")));
}

TEST(Warnings, NameTheFormatThatIsMissing) {
  const MissionVerdict verdict = judgeMissionText(
      "<root><BehaviorTree ID=\"M\"><Sequence><TakeOff/><Land/></Sequence></BehaviorTree></root>", "m.xml");
  EXPECT_THAT(verdict.problems, IsEmpty());
  EXPECT_THAT(linesOf(verdict.warnings), ElementsAre(HasSubstr("write <root BTCPP_format=\"4\">")));
}

TEST(Problems, HaveThePathOfTheirNode) {
  EXPECT_THAT(linesOf(verdictOn("<Priority><Hold/><Sequence><TakeOff/></Sequence><Sequence><TakeOff "
                                "height_m=\"-1\"/><MoveToGoal/></Sequence></Priority>")
                          .problems),
              ElementsAre(HasSubstr("`-1` is out of range, expected a number in metres from 0.3 to"),
                          HasSubstr("port `goal` is missing")));
  const std::vector<tree::Problem> values =
      verdictOn(
          "<Priority><Hold/><Sequence><TakeOff/></Sequence><Sequence><TakeOff height_m=\"-1\"/></Sequence>"
          "</Priority>")
          .problems;
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].path, "M/Priority/Sequence[2]/TakeOff");
  const std::vector<tree::Problem> entries =
      verdictOn("<Sequence><TakeOff/>\n<MoveToGoal goal=\"{door}\"/></Sequence>").problems;
  EXPECT_THAT(linesOf(entries), ElementsAre("m.xml:4:13: MoveToGoal.goal: nothing sets the entry {door} "
                                            "[M/Sequence/MoveToGoal]"));
  const std::vector<tree::Problem> scripted =
      verdictOn(
          "<Sequence><Script code=\"far := 9.5\"/><TakeOff/>\n<MoveToGoal goal=\"1;1\" "
          "tolerance_m=\"{far}\"/></Sequence>")
          .problems;
  EXPECT_THAT(linesOf(scripted), ElementsAre(HasSubstr("`9.5` is out of range, expected a number in metres from 0.01 "
                                                       "to 5 (read by MoveToGoal.tolerance_m from {far}) "
                                                       "[M/Sequence/Script]")));
  const std::vector<tree::Problem> floor = verdictOn("<Sequence><GoHome/><TakeOff/></Sequence>").problems;
  ASSERT_EQ(floor.size(), 1U);
  EXPECT_EQ(floor[0].path, "M/Sequence/GoHome");
}

TEST(ShippedMissions, HaveNoWarnings) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(SWIFTLET_SOURCE_DIR) + "/missions")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_THAT(linesOf(judgeMission(entry.path().string(), {.max_height_m = 3.0}).warnings), IsEmpty());
    ++count;
  }
  EXPECT_GE(count, 5);
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
