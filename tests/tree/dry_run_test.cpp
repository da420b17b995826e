// A tree ticked with scripted answers of its leaves: the script as people write it, and the trace.
#include <ctime>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/dry_run.hpp"
#include "tests/support/scratch.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Flying, holding and asking, without anything that flies.
Registry flyingRegistry() {
  Registry registry = Registry::standard();
  const auto build = registry.find("AlwaysSuccess")->build;
  registry.add({.id = "Fly", .kind = NodeKind::kAction, .ports = {{.name = "goal", .required = true}}}, build);
  registry.add({.id = "Climb", .kind = NodeKind::kAction, .ports = {{.name = "height_m", .type = PortType::kDouble}}},
               build);
  registry.add({.id = "Find",
                .kind = NodeKind::kAction,
                .ports = {{.name = "height_m", .type = PortType::kDouble, .direction = Direction::kOutput}}},
               build);
  registry.add({.id = "Land", .kind = NodeKind::kAction}, build);
  registry.add({.id = "Hold", .kind = NodeKind::kAction, .may_skip = true}, build);
  registry.add({.id = "IsLow", .kind = NodeKind::kCondition}, build);
  return registry;
}

/// A dry run to its end.
struct Ran {
  std::vector<std::string> unscripted;
  std::vector<DryRunTick> ticks;
  std::vector<Problem> problems;
};

class DryRuns : public test_support::Scratch {
 protected:
  Ran run(const std::string& inside, const std::string& script, bool mocks = false) const {
    const Registry registry = flyingRegistry();
    DryRun run(write("m.xml", file(inside)), registry, readOutcomeScript(script, "s.txt"), mocks);
    Ran ran{run.unscripted(), {}, run.problems()};
    while (auto tick = run.tick()) ran.ticks.push_back(std::move(*tick));
    return ran;
  }
  /// "RUNNING RUNNING SUCCESS".
  static std::string answers(const Ran& run) {
    std::string text;
    for (const DryRunTick& tick : run.ticks) text += (text.empty() ? "" : " ") + std::string(toString(tick.answer));
    return text;
  }
};

TEST(OutcomeScripts, AreReadLineByLine) {
  const OutcomeScript script = readOutcomeScript(
      "# a comment\n\nticks: 7\n tick_ms: 50\r\nM/Fly: RUNNING x2 , FAILURE\nIsLow: false x 3, true", "s.txt");
  EXPECT_THAT(script.problems, IsEmpty());
  EXPECT_EQ(script.ticks, 7);
  EXPECT_EQ(script.tick_ms, 50);
  ASSERT_EQ(script.leaves.size(), 2U);
  EXPECT_EQ(script.leaves[0].leaf, "M/Fly");
  EXPECT_THAT(script.leaves[0].answers, ElementsAre(Status::kRunning, Status::kRunning, Status::kFailure));
  EXPECT_THAT(script.leaves[1].answers,
              ElementsAre(Status::kFailure, Status::kFailure, Status::kFailure, Status::kSuccess));
}

TEST(OutcomeScripts, MistakesHaveAPlace) {
  const auto problemsOf = [](const char* text) { return readOutcomeScript(text, "s.txt").problems; };
  EXPECT_THAT(problemsOf("Fly RUNNING"), ElementsAre(At("1:1", "tree.answers-line")));
  EXPECT_THAT(problemsOf("\n  Fly: DONE"), ElementsAre(At("2:3 Fly", "tree.unknown-answer", "`DONE`")));
  for (const char* wrong : {"Fly:", "Fly: RUNNING x0", "Fly: RUNNING 3", "Fly: RUNNING,", "Fly: IDLE", "ticks: 0",
                            "ticks: many", "tick_ms: -5", "Fly: RUNNING x999999999", ": RUNNING"})
    EXPECT_EQ(problemsOf(wrong).size(), 1U) << wrong;
}

TEST(OutcomeScripts, MayHaveCommentsBehindAnswersAndAByteOrderMark) {
  const OutcomeScript script = readOutcomeScript(
      "\xEF\xBB\xBF"
      "Fly: RUNNING, SUCCESS # as: usual\n  # Land: FAILURE\nM/Go #2: FAILURE\nticks: 7 # few",
      "s.txt");
  EXPECT_THAT(script.problems, IsEmpty());
  ASSERT_EQ(script.leaves.size(), 2U);
  EXPECT_EQ(script.leaves[0].leaf, "Fly");
  EXPECT_THAT(script.leaves[0].answers, ElementsAre(Status::kRunning, Status::kSuccess));
  EXPECT_EQ(script.leaves[1].leaf, "M/Go #2");
  EXPECT_EQ(script.ticks, 7);
}

TEST(OutcomeScripts, NameALeafOnce) {
  EXPECT_THAT(readOutcomeScript("Fly: SUCCESS\nLand: SUCCESS\nFly: FAILURE", "s.txt").problems,
              ElementsAre(At("3:1 Fly", "tree.answers-twice", "line 1")));
}

TEST_F(DryRuns, LeavesReadTheirInputs) {
  const auto climb = [this](const std::string& before) {
    const Ran made = run("<Sequence>" + before + "<Climb height_m=\"{h}\"/></Sequence>", "Climb: RUNNING, SUCCESS");
    EXPECT_THAT(made.problems, IsEmpty());
    return made.ticks.back().answer == Status::kSuccess ? "done" : made.ticks.back().events.front();
  };
  EXPECT_EQ(climb("<SetBlackboard value=\"1\" output_key=\"h\"/>"), "done");
  EXPECT_EQ(climb("<Find height_m=\"{h}\"/>"), "done") << "what a leaf writes has a value";
  EXPECT_THAT(run("<Sequence><SetBlackboard value=\"1\" output_key=\"h\"/><UnsetBlackboard key=\"h\"/>"
                  "<Climb height_m=\"{h}\"/></Sequence>",
                  "")
                  .ticks.back()
                  .events,
              ::testing::Contains("Main/Sequence/Climb fails: port height_m: the entry {h} is not set"));
  EXPECT_THAT(
      run("<Sequence><Script code=\"h := 'a' .. 'b'\"/><Climb height_m=\"{h}\"/></Sequence>", "").ticks.back().events,
      ::testing::Contains(HasSubstr("the entry {h} is `ab`, expected a number in metres")));
}

TEST_F(DryRuns, TellWhatHappensTickByTick) {
  const Ran run = this->run("<Sequence><Fly goal=\"a\"/><Land/></Sequence>", "Fly: RUNNING x2, SUCCESS\ntick_ms: 50");
  EXPECT_THAT(run.problems, IsEmpty());
  EXPECT_THAT(run.unscripted, ElementsAre("Main/Sequence/Land: SUCCESS"));
  ASSERT_EQ(answers(run), "RUNNING RUNNING SUCCESS");
  EXPECT_EQ(run.ticks[1].now_ns, 100'000'000);
  EXPECT_THAT(run.ticks[0].events, ElementsAre("Main/Sequence/Fly: IDLE -> RUNNING", "Main/Sequence: IDLE -> RUNNING"));
  EXPECT_THAT(run.ticks[1].events, IsEmpty());
  EXPECT_THAT(run.ticks[2].events,
              ElementsAre("Main/Sequence/Fly: RUNNING -> SUCCESS", "Main/Sequence/Land: IDLE -> SUCCESS",
                          "Main/Sequence: RUNNING -> SUCCESS"));
}

TEST_F(DryRuns, ALeafIsNamedByPathNameOrType) {
  const Ran run = this->run("<Sequence><Fly goal=\"a\"/><Fly goal=\"b\" name=\"second\"/><Fly goal=\"c\"/></Sequence>",
                            "Fly: SUCCESS\nsecond: RUNNING, SUCCESS\nMain/Sequence/Fly[2]: RUNNING x2, FAILURE");
  EXPECT_THAT(run.problems, IsEmpty());
  EXPECT_EQ(answers(run), "RUNNING RUNNING RUNNING FAILURE");
}

TEST_F(DryRuns, AnswersGoOnWhereALeafStartsAnew) {
  EXPECT_EQ(answers(run("<RetryUntilSuccessful num_attempts=\"5\"><Fly goal=\"a\"/></RetryUntilSuccessful>",
                        "Fly: RUNNING, FAILURE, FAILURE, RUNNING, SUCCESS")),
            "RUNNING RUNNING RUNNING SUCCESS");
}

TEST_F(DryRuns, ASkippedAnswerIsUsedUpByATick) {
  const Ran run = this->run("<Priority><Hold/><Fly goal=\"a\"/></Priority>",
                            "Hold: SKIPPED x2, RUNNING, SUCCESS, SKIPPED\nFly: RUNNING x4, SUCCESS");
  EXPECT_THAT(run.problems, IsEmpty());
  // Fly is ticked in all but the third tick, in which Hold has the vehicle.
  EXPECT_EQ(answers(run), "RUNNING RUNNING RUNNING RUNNING RUNNING SUCCESS");
  EXPECT_THAT(run.ticks[2].events, ::testing::Contains(HasSubstr("Hold takes over from Fly")));
}

TEST_F(DryRuns, AConditionIsAskedByTheTick) {
  // Were it by question, it would be true in the second tick, in which it is asked for the second time.
  EXPECT_EQ(
      answers(run("<Sequence><Fly goal=\"a\"/><IsLow/></Sequence>", "Fly: RUNNING x3, SUCCESS\nIsLow: true x3, false")),
      "RUNNING RUNNING RUNNING FAILURE");
}

TEST_F(DryRuns, TheEnginesLeavesAndTimesAreReal) {
  const Ran run = this->run(
      "<Sequence><Script code=\"n := 2\"/><Sleep msec=\"250\"/><ScriptCondition code=\"n == 2\"/>"
      "<Timeout msec=\"300\"><Fly goal=\"a\"/></Timeout></Sequence>",
      "Fly: RUNNING");
  EXPECT_EQ(run.ticks.back().answer, Status::kFailure);
  EXPECT_THAT(run.ticks.back().events, ::testing::Contains(HasSubstr("Main/Sequence/Timeout fails: ")));
}

TEST_F(DryRuns, OfWideTreesTakeAMoment) {
  const std::clock_t start = std::clock();
  std::string leaves;
  for (int i = 0; i < 20'000; ++i) leaves += "<Land/>";
  const Ran made = run("<Sequence>" + leaves + "</Sequence>", "Land: SUCCESS x50000\n");
  EXPECT_EQ(made.ticks.at(0).events.size(), 20'001U);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 3.0);
}

TEST_F(DryRuns, StopAtTheLimit) { EXPECT_EQ(run("<Fly goal=\"a\"/>", "Fly: RUNNING\nticks: 5").ticks.size(), 5U); }

TEST_F(DryRuns, ScriptsThatDoNotFitAreRefused) {
  const auto problemsOf = [this](const char* script) {
    const Ran made = run("<Priority><Hold/><Sequence><IsLow/><Sleep msec=\"1\"/><Land/></Sequence></Priority>", script);
    EXPECT_THAT(made.ticks, IsEmpty());
    return made.problems;
  };
  EXPECT_THAT(problemsOf("Lnd: SUCCESS"), ElementsAre(At("1:1 Lnd", "tree.unknown-leaf", "`Land`?")));
  EXPECT_THAT(problemsOf("Sleep: SUCCESS"), ElementsAre(At("1:1 Sleep", "tree.answers-of-engine")));
  EXPECT_THAT(problemsOf("Land: SKIPPED"), ElementsAre(At("1:1 Land", "tree.answers-skipped")));
  EXPECT_THAT(problemsOf("IsLow: RUNNING"), ElementsAre(At("1:1 IsLow", "tree.answers-of-condition")));
  EXPECT_THAT(problemsOf("Land: SUCCESS\nMain/Priority/Sequence/Land: SUCCESS"),
              ElementsAre(At("1:1 Land", "tree.answers-unused")));
}

TEST_F(DryRuns, PortsAreCheckedAsInFlight) {
  EXPECT_THAT(run("<Fly/>", "Fly: SUCCESS").problems, ElementsAre(At("3:1 Fly", "tree.port-missing", "`goal`")));
  EXPECT_THAT(run("<Dive/>", "").problems, ElementsAre(At("3:1 Dive", "tree.unknown-node")));
}

TEST_F(DryRuns, NodesOfOtherProgramsAnswerToo) {
  EXPECT_EQ(answers(run("<Sequence><Dive depth=\"3\"/><Land/></Sequence>", "Dive: RUNNING, FAILURE", true)),
            "RUNNING FAILURE");
}

}  // namespace
}  // namespace swiftlet::tree::testing
