// Scripted conditions of nodes, tick by tick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A tree with the entry `n`, which `set` changes between two ticks.
std::string counting(std::string_view inside) {
  return "<Sequence><Script code=\"n := 0\"/>" + std::string(inside) + "</Sequence>";
}

TEST(Conditions, DecideBeforeTheNodeStarts) {
  EXPECT_EQ(Story("<A _successIf=\"1 &lt; 2\"/>").tick(), "SUCCESS");
  EXPECT_EQ(Story("<A _failureIf=\"true\"/>").tick(), "FAILURE");
  EXPECT_EQ(Story("<A _skipIf=\"true\"/>").tick(), "SKIPPED");
  EXPECT_EQ(Story("<A _while=\"false\"/>").tick(), "SKIPPED");
  EXPECT_EQ(Story("<A _failureIf=\"true\" _successIf=\"true\"/>").tick(), "FAILURE") << "in this order";
  EXPECT_EQ(Story("<A _failureIf=\"false\" _successIf=\"false\" _skipIf=\"false\" _while=\"true\"/>").tick(),
            "RUNNING: start A");
}

TEST(Conditions, AreNotAskedOfANodeThatIsUnderWay) {
  Story story(
      counting("<Parallel><A _skipIf=\"n > 0\"/><Sequence><B/><Script code=\"n = 1\"/><C/></Sequence></Parallel>"));
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  EXPECT_EQ(story.tick(), "RUNNING: A, C");
}

TEST(Conditions, WhileHaltsTheNodeAndItIsSkippedOnceItHasLetGo) {
  Story story(
      counting("<Parallel><A _while=\"n == 0\"/><Sequence><B/><Script code=\"n = 1\"/><C/></Sequence></Parallel>"));
  story.says("A", "RUNNING, stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, B, start C");
  EXPECT_EQ(story.tick(), "RUNNING: A halting, C");
  EXPECT_EQ(story.tick(), "RUNNING: A halted, C");
  EXPECT_THAT(story.view(), HasSubstr("A SKIPPED"));
}

TEST(Conditions, RunAfterTheEnd) {
  Story story(
      "<Sequence><Fallback><A _onSuccess=\"x := 'well'\" _onFailure=\"x := 'badly'\" _post=\"y := x\"/>"
      "<AlwaysSuccess/></Fallback><ScriptCondition code=\"x == 'badly' &amp;&amp; y == 'badly'\"/></Sequence>");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

TEST(Conditions, RunAfterAHaltOnceTheNodeHasLetGo) {
  Story story(
      "<Sequence><Script code=\"x := 0\"/><Fallback><Timeout msec=\"150\"><A _onHalted=\"x = 7\"/></Timeout>"
      "<ScriptCondition code=\"x == 7\"/></Fallback></Sequence>");
  story.says("A", "RUNNING, stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: A");
  EXPECT_EQ(story.tick(), "RUNNING: A halting");
  EXPECT_EQ(story.tick(), "SUCCESS: A halted");
}

TEST(Conditions, APriorityAsksThemWithoutStartingTheNode) {
  Story story("<Priority><A _skipIf=\"true\"/><B/></Priority>");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
}

TEST(Conditions, OfASubTreeAreAskedInTheOuterTree) {
  Story story("<Sequence><Script code=\"busy := true\"/><SubTree ID=\"Inner\" _skipIf=\"busy\"/></Sequence>",
              "<BehaviorTree ID=\"Inner\"><A/></BehaviorTree>");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Conditions, ThatCannotBeEvaluatedMakeTheNodeFailWithTheReason) {
  Story story("<Sequence><SetBlackboard value=\"maybe\" output_key=\"x\"/><A _skipIf=\"x\"/></Sequence>");
  EXPECT_EQ(story.tick(), "FAILURE");
  EXPECT_THAT(story.failures(), ElementsAre("A: _skipIf: is text, expected true or false"));
  Story after("<A _onSuccess=\"x := 1 / (1 - 1)\"/>");
  after.says("A", "SUCCESS");
  EXPECT_EQ(after.tick(), "FAILURE: start A");
  EXPECT_THAT(after.failures(), ElementsAre("A: _onSuccess: division by zero"));
}

TEST(Conditions, ProblemsAreFoundBeforeTheFirstTick) {
  EXPECT_THAT(problemsInside("<A _skipIf=\"1 +\"/>"), ElementsAre(At("3:4 A._skipIf", "tree.script-syntax", "`1 +`")));
  EXPECT_THAT(problemsInside("<Sequence><Script code=\"x := 1\"/><A _skipIf=\"x = 2\"/></Sequence>"),
              ElementsAre(At("3:37 A._skipIf", "tree.script-assigns", "==")));
  EXPECT_THAT(problemsInside("<Script code=\"x := 1 / 0\"/>"),
              ElementsAre(At("3:9 Script.code", "tree.script-division")));
  EXPECT_THAT(problemsInside("<A _skipIf=\"1 / 0.0 > 2\"/>"), ElementsAre(At("3:4 A._skipIf", "tree.script-division")));
  EXPECT_THAT(problemsInside("<A _while=\"ready\"/>"), ElementsAre(At("3:4 A._while", "tree.entry-unset", "{ready}")));
  EXPECT_THAT(problemsInside("<Script code=\"x = 1\"/>"),
              ElementsAre(At("3:9 Script.code", "tree.entry-unset", "{x}")));
  EXPECT_THAT(problemsInside("<Sequence><Script code=\"t := 'soon'\"/><Sleep msec=\"{t}\"/></Sequence>"),
              ElementsAre(At("3:19 code", "tree.value-type", "`soon`")));
}

}  // namespace
}  // namespace swiftlet::tree::testing
