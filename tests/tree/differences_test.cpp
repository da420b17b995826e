// What differs from BehaviorTree.CPP 4 in the reading of a file: the rows of docs/behaviors.md that no other test
// shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

constexpr const char* kVisit = R"(<BehaviorTree ID="Visit"><A/></BehaviorTree>)";

TEST(Differences, UnknownAttributesAreRefused) {
  EXPECT_THAT(problemsInside(R"(<A _meta="5"/>)"), ElementsAre(At("3:4 A", "tree.unknown-attribute", "`_meta`")));
  Story unread(R"(<SubTree ID="Visit" place="1;2"/>)", kVisit);
  EXPECT_THAT(unread.problems(), ElementsAre(At("3:21 SubTree", "tree.unknown-entry", "{place}", "[Main/Visit]")));
}

TEST(Differences, TextBetweenElementsIsRefused) {
  for (const char* inside : {"<Sequence>first<A/></Sequence>", "<Sequence><A/><![CDATA[ last ]]></Sequence>"})
    EXPECT_EQ(problemsInside(inside).at(0).message.name(), "tree.stray-text");
}

TEST(Differences, TwoTreesOfOneIdAreRefused) {
  Story twice(R"(<SubTree ID="Visit"/>)", std::string(kVisit) + kVisit);
  EXPECT_THAT(twice.problems(), ElementsAre(At("5:45 BehaviorTree", "tree.defined-twice", "`Visit`", "story.xml")));
}

TEST(Differences, AnEqualSignAloneIsText) {
  Story story(R"(<Sequence><SetBlackboard value="=" output_key="x"/><ScriptCondition code="x == '='"/></Sequence>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Differences, AKeyInBracesIsTheEntryItself) {
  Story story(
      R"(<Sequence><Script code="k := 'other'"/><SetBlackboard value="1" output_key="{k}"/><ScriptCondition code="k == 1"/></Sequence>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Differences, AScriptStandsInTheFile) {
  EXPECT_THAT(problemsInside(R"(<Sequence><Script code="c := 'x := 1'"/><Script code="{c}"/></Sequence>)"),
              ElementsAre(At("3:49 Script.code", "tree.script-in-entry", "{c}")));
}

TEST(Differences, ADefaultMayBeEmpty) {
  Story story(
      R"(<SubTree ID="Ask"/>)",
      R"(<BehaviorTree ID="Ask"><ScriptCondition code="word == ''"/></BehaviorTree><TreeNodesModel><SubTree ID="Ask"><input_port name="word" default=""/></SubTree></TreeNodesModel>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Differences, ASkippedChildDecidesNothingInAParallel) {
  Story story(R"(<Parallel success_count="-2"><A/><B/></Parallel>)");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start B") << "not before B was ticked";
}

TEST(Differences, TheConditionOfAWhileDoElseStartsAnewAtEveryTick) {
  Story asked(R"(<Sequence><Script code="n := 0"/><WhileDoElse><A _failureIf="n == 1"/><KeepRunningUntilFailure>)"
              R"(<Script code="n = 1"/></KeepRunningUntilFailure><C/></WhileDoElse></Sequence>)");
  asked.says("A", "SUCCESS");
  EXPECT_EQ(asked.tick(), "RUNNING: start A");
  EXPECT_EQ(asked.tick(), "RUNNING: start C");
  Story sleeping(R"(<WhileDoElse><Sleep msec="100"/><B/></WhileDoElse>)");
  EXPECT_EQ(sleeping.tick(), "RUNNING");
  EXPECT_EQ(sleeping.tick(), "RUNNING: start B");
  EXPECT_EQ(sleeping.tick(), "RUNNING") << "sleeps again";
  EXPECT_EQ(sleeping.tick(), "RUNNING: B");
}

constexpr const char* kZeroOnce = R"(<RunOnce then_skip="false"><Script code="n := 0"/></RunOnce>)";

TEST(Differences, AFailedConditionOfAnIfThenElseStartsAnew) {
  Story story("<Sequence>" + std::string(kZeroOnce) +
              R"(<Fallback><IfThenElse><A _successIf="n == 1"/><B/></IfThenElse><Script code="n += 1"/></Fallback>)"
              "</Sequence>");
  EXPECT_EQ(story.says("A", "FAILURE").tick(), "SUCCESS: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
}

TEST(Differences, ASkippedConditionSkipsAChoice) {
  for (const char* choice : {"IfThenElse", "WhileDoElse"}) {
    const std::string tag = choice;
    Story story("<" + tag + "><A/><B/><C/></" + tag + ">");
    EXPECT_EQ(story.says("A", "nothing").tick(), "SKIPPED") << tag;
  }
}

TEST(Differences, APreconditionIsAskedAtEachStartOfItsChild) {
  Story skipped("<Sequence>" + std::string(kZeroOnce) +
                R"(<Precondition if="n == 0" else="SUCCESS"><A/></Precondition><Script code="n = 1"/></Sequence>)");
  EXPECT_EQ(skipped.says("A", "nothing").tick(), "SUCCESS");
  EXPECT_EQ(skipped.says("A", "RUNNING").tick(), "SUCCESS");
  Story halted("<Sequence>" + std::string(kZeroOnce) +
               R"(<Precondition if="n == 0" else="SUCCESS"><A _onHalted="n = 1"/></Precondition></Sequence>)");
  EXPECT_EQ(halted.tick(), "RUNNING: start A");
  EXPECT_EQ(halted.halt(), "let go: A halted");
  EXPECT_EQ(halted.tick(), "SUCCESS");
}

TEST(Differences, NamesThatBehaviorTreeCppRefusesAreTaken) {
  Story twice(R"(<Sequence><SubTree ID="Visit" name="V"/><SubTree ID="Visit" name="V"/></Sequence>)", kVisit);
  EXPECT_EQ(twice.says("A", "SUCCESS").tick(), "SUCCESS: start A, start A");
  Story marks(R"(<SubTree ID="at 1.5/2:00"/>)", R"(<BehaviorTree ID="at 1.5/2:00"><A/></BehaviorTree>)");
  EXPECT_EQ(marks.tick(), "RUNNING: start A");
}

TEST(Differences, AReactiveSequenceMayHaveTwoAsyncSequences) {
  Story story(
      "<ReactiveSequence><AsyncSequence><A/></AsyncSequence><AsyncSequence><B/></AsyncSequence></ReactiveSequence>");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: start A, start B");
}

TEST(Differences, UnsetBlackboardTakesTheEntryItself) {
  Story story(R"(<Sequence><Script code="k := 'other'; other := 1"/><UnsetBlackboard key="{k}"/>)"
              R"(<ScriptCondition code="other == 1"/><ScriptCondition code="k == 'other'"/></Sequence>)");
  EXPECT_EQ(story.tick(), "FAILURE");
  EXPECT_THAT(story.failures(), ElementsAre("ScriptCondition: code: the entry {k} is not set"));
}

TEST(Differences, WhatIsWrittenAfterUnsetBlackboardIsNews) {
  Story story(R"(<Sequence><Script code="k := 1"/><WasEntryUpdated entry="k"/><UnsetBlackboard key="k"/></Sequence>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Paths, AreGivenForWhatIsFoundWhenTheTreeIsBuilt) {
  const auto pathOfFirst = [](const std::string& inside, const std::string& more = {}) {
    const Story story(inside, more);
    return story.problems().empty() ? "no problem" : story.problems()[0].path;
  };
  EXPECT_EQ(
      pathOfFirst("<Sequence><Fallback><A/></Fallback><Fallback><IfThenElse><A/></IfThenElse></Fallback></Sequence>"),
      "Main/Sequence/Fallback[2]/IfThenElse");
  EXPECT_EQ(pathOfFirst(R"(<Sequence><A/><SubTree ID="Loop"/></Sequence>)",
                        R"(<BehaviorTree ID="Loop"><Fallback><A/><SubTree ID="Loop"/></Fallback></BehaviorTree>)"),
            "Loop/Fallback/Loop");
  std::string deep = "<A/>", more;
  for (int i = 0; i < 5; ++i) deep = "<Inverter>" + deep + "</Inverter>";
  for (int i = 0; i < 60; ++i)
    more += "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><Inverter><Inverter><Inverter><SubTree ID=\"T" +
            std::to_string(i + 1) + "\"/></Inverter></Inverter></Inverter></BehaviorTree>";
  more += "<BehaviorTree ID=\"T60\"><A/></BehaviorTree>";
  const std::string path = pathOfFirst("<SubTree ID=\"T0\"/>", more);
  EXPECT_TRUE(path.starts_with("Main/T0/Inverter/Inverter/Inverter/T1/")) << path;
  EXPECT_TRUE(path.ends_with("/T49/Inverter/Inverter/Inverter/T50")) << path;
  EXPECT_LT(path.size(), 450U);
}

}  // namespace
}  // namespace swiftlet::tree::testing
