// What `check` warns of: missions that can be flown, but are probably not meant so.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<tree::Problem> warningsOf(const std::string& inside) {
  const MissionVerdict verdict = verdictOn(inside);
  EXPECT_THAT(verdict.problems, IsEmpty()) << inside;
  return verdict.warnings;
}

TEST(Warnings, NameNodesThatAreNeverReached) {
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<Fallback><AlwaysSuccess/><GoHome/></Fallback><Land/></Sequence>"),
              ElementsAre(At("4:27 GoHome", "mission.unreached", "`AlwaysSuccess`", "[M/Sequence/Fallback/GoHome]")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<Patrol points=\"1;1|2;2\" rounds=\"0\"/><Land/></Sequence>"),
              ElementsAre(At("4:38 Land", "mission.unreached", "`Patrol`"), At("3:1 Sequence", "mission.no-landing")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/>\n<OperatorCommand/><Land/></Sequence>"),
              ElementsAre(At("4:19 Land", "mission.unreached", "`OperatorCommand`")));
}

TEST(Warnings, NameAFlightAboveFurnitureByALaserAlone) {
  MissionLimits limits;
  limits.unseen_below_m = 0.2;
  const auto warnings = [&limits](const std::string& height_m) {
    return verdictOn("<Sequence><TakeOff height_m=\"" + height_m + "\"/><Explore/><Land/></Sequence>", limits).warnings;
  };
  EXPECT_THAT(warnings("1.4"), ElementsAre(At("3:11 TakeOff", "mission.unseen-below", "between 1.20 and 1.40 m")));
  EXPECT_THAT(warnings("1.2"), IsEmpty());
  limits.unseen_below_m = 0.0;
  EXPECT_THAT(warnings("1.4"), IsEmpty());
}

TEST(Warnings, NameWhatWaitsForAnOperatorWhoIsNotThere) {
  const std::string inside =
      "<Sequence><TakeOff/>\n<WaitForOperator/><WaitForOperator timeout_s=\"30\"/><LogEvent text=\"a\"/>"
      "<OperatorCommand/></Sequence>";
  EXPECT_THAT(warningsOf(inside), IsEmpty());
  MissionLimits limits;
  limits.operator_goes_on = limits.operator_gives_goals = false;
  EXPECT_THAT(verdictOn(inside, limits).warnings,
              ElementsAre(At("4:1 WaitForOperator", "mission.nobody-goes-on", "[M/Sequence/WaitForOperator[1]]"),
                          At("4:19 WaitForOperator", "mission.nobody-goes-on", "timeout_s"),
                          At("4:72 OperatorCommand", "mission.nobody-gives-goals")));
  const auto onWaiterIn = [&](const std::string& begin, const std::string& end) {
    return verdictOn("<Sequence><TakeOff/>" + begin + "<WaitForOperator/>" + end + "<Land/></Sequence>", limits)
        .warnings;
  };
  EXPECT_THAT(onWaiterIn("<Timeout msec=\"9000\">", "</Timeout>"),
              ElementsAre(At("3:42 WaitForOperator", "mission.nobody-goes-on", "until the Timeout")));
  EXPECT_THAT(onWaiterIn("<Timeout msec=\"0\">", "</Timeout>"),
              ElementsAre(At("3:39 WaitForOperator", "mission.nobody-goes-on", "without an end")));
  EXPECT_THAT(onWaiterIn("<ReactiveSequence><AlwaysSuccess/>", "</ReactiveSequence>"),
              ElementsAre(At("3:55 WaitForOperator", "mission.nobody-goes-on", "until something else")));
  limits.operator_gives_goals = true;
  EXPECT_THAT(verdictOn(inside, limits).warnings.size(), 2U);
  EXPECT_THAT(verdictOn("<Sequence><TakeOff/><Land/><Fallback><AlwaysSuccess/><WaitForOperator/></Fallback>"
                        "</Sequence>",
                        limits)
                  .warnings,
              ElementsAre(At("3:54 WaitForOperator", "mission.unreached")))
      << "what is never reached waits for nobody";
}

TEST(Warnings, AgreeWithTheOrderOfFlightOnWhatCannotFail) {
  for (const char* leaf : {"<SetFlightMode mode=\"fast\"/>", "<LogEvent text=\"a\"/>", "<Sleep msec=\"5\"/>"})
    EXPECT_THAT(
        warningsOf("<Sequence><TakeOff/><Fallback>" + std::string(leaf) + "\n<Land/></Fallback><Land/></Sequence>"),
        ElementsAre(At("4:1 Land", "mission.unreached")))
        << leaf;
}

TEST(Warnings, NameAParallelOfTwoThatFly) {
  EXPECT_THAT(
      warningsOf("<Sequence><TakeOff/>\n<Parallel><MoveToGoal goal=\"1;1\"/><Sequence><LogEvent text=\"a\"/><Explore "
                 "name=\"look\"/></Sequence></Parallel><Land/></Sequence>"),
      ElementsAre(At("4:1 Parallel", "mission.two-fly", "`MoveToGoal`", "`look`", "[M/Sequence/Parallel]")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><ParallelAll><Explore/><Sequence><IsLost/><LogEvent text=\"a\"/>"
                         "</Sequence><Hold/></ParallelAll><Land/></Sequence>"),
              IsEmpty());
}

TEST(Warnings, NameAMissionThatNeverLands) {
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><GoHome/></Sequence>"),
              ElementsAre(At("3:1 Sequence", "mission.no-landing", "[M/Sequence]")));
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
                ElementsAre(At("3:1 Sequence", "mission.ends-in-the-air", "[M/Sequence]")))
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
              ElementsAre(At("4:1 Land", "mission.unreached", "`_skipIf`"), At("3:1 Sequence", "mission.no-landing")));
  EXPECT_THAT(warningsOf("<Sequence><TakeOff/><FollowMe/>\n<GoHome/><Land/></Sequence>"),
              ElementsAre(At("4:1 GoHome", "mission.unreached", "`FollowMe`"), At("4:10 Land", "mission.unreached"),
                          At("3:1 Sequence", "mission.no-landing")));
}

TEST(Warnings, NameTheFormatThatIsMissing) {
  const MissionVerdict verdict = judgeMissionText(
      "<root><BehaviorTree ID=\"M\"><Sequence><TakeOff/><Land/></Sequence></BehaviorTree></root>", "m.xml");
  EXPECT_THAT(verdict.problems, IsEmpty());
  EXPECT_THAT(verdict.warnings, ElementsAre(At("1:1 root", "tree.format-assumed")));
}

TEST(Problems, HaveThePathOfTheirNode) {
  EXPECT_THAT(verdictOn("<Priority><Hold/><Sequence><TakeOff/></Sequence><Sequence><TakeOff "
                        "height_m=\"-1\"/><MoveToGoal/></Sequence></Priority>")
                  .problems,
              ElementsAre(At("3:68 TakeOff.height_m", "tree.value-range", "`-1`", "[M/Priority/Sequence[2]/TakeOff]"),
                          At("3:83 MoveToGoal", "tree.port-missing", "`goal`")));
  EXPECT_THAT(problemsOf("<Sequence><TakeOff/>\n<MoveToGoal goal=\"{door}\"/></Sequence>"),
              ElementsAre(At("4:13 MoveToGoal.goal", "tree.entry-unset", "{door}", "[M/Sequence/MoveToGoal]")));
  EXPECT_THAT(problemsOf("<Sequence><Script code=\"far := 9.5\"/><TakeOff/>\n<MoveToGoal goal=\"1;1\" "
                         "tolerance_m=\"{far}\"/></Sequence>"),
              ElementsAre(At("3:19 code", "tree.value-range", "`9.5`", "MoveToGoal.tolerance_m", "{far}",
                             "[M/Sequence/Script]")));
  EXPECT_THAT(problemsOf("<Sequence><GoHome/><TakeOff/></Sequence>"),
              ElementsAre(At("3:11 GoHome", "mission.on-the-floor", "[M/Sequence/GoHome]")));
}

TEST(ShippedMissions, HaveNoWarnings) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(SWIFTLET_SOURCE_DIR) + "/missions")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_THAT(judgeMission(entry.path().string(), {.max_height_m = 3.0}).warnings, IsEmpty());
    ++count;
  }
  EXPECT_GE(count, 5);
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
