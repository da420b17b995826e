// How nodes may end, and which are never ticked. An exhaustive run of small trees is the oracle of what may happen.
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/outcomes.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// "Main/Sequence/A: why".
std::vector<std::string> unreachedIn(const std::string& inside) {
  Stage stage;
  const Registry registry = withStandIns(stage);
  const ParseResult parsed = parseText(file(inside), "f.xml", registry);
  EXPECT_TRUE(parsed.tree.has_value()) << toString(parsed.problems);
  if (!parsed.tree) return {};
  std::vector<std::string> lines;
  for (const Unreached& node : unreachedNodes(*parsed.tree, outcomesOf(*parsed.tree)))
    lines.push_back(parsed.tree->pathOf(node.node) + ": " + node.why);
  return lines;
}

TEST(UnreachedNodes, FollowOneThatAlwaysEndsTheChain) {
  EXPECT_THAT(unreachedIn("<Fallback><AlwaysSuccess/><A/></Fallback>"),
              ElementsAre("Main/Fallback/A: `AlwaysSuccess` before it never fails"));
  EXPECT_THAT(unreachedIn("<Sequence><AlwaysFailure/><A/><B/></Sequence>"),
              ElementsAre("Main/Sequence/A: `AlwaysFailure` before it never succeeds",
                          "Main/Sequence/B: `AlwaysFailure` before it never succeeds"));
  EXPECT_THAT(
      unreachedIn(
          "<ReactiveFallback><ForceSuccess><ScriptCondition code=\"1 &lt; 2\"/></ForceSuccess><Sequence><B/></Sequence>"
          "</ReactiveFallback>"),
      ElementsAre("Main/ReactiveFallback/Sequence: `ForceSuccess` before it never fails"));
  EXPECT_THAT(unreachedIn("<Sequence><Repeat num_cycles=\"-1\"><Inverter><AlwaysFailure/></Inverter></Repeat><A/>"
                          "</Sequence>"),
              ElementsAre("Main/Sequence/A: `Repeat` before it never ends"));
  EXPECT_THAT(unreachedIn("<Fallback><RetryUntilSuccessful num_attempts=\"-1\"><ScriptCondition code=\"1 &lt; "
                          "2\"/></RetryUntilSuccessful><B/>"
                          "</Fallback>"),
              ElementsAre("Main/Fallback/B: `RetryUntilSuccessful` before it never fails"));
}

TEST(UnreachedNodes, AreExcludedByWhatTheFileFixes) {
  EXPECT_THAT(unreachedIn("<IfThenElse><AlwaysSuccess/><A/><B/></IfThenElse>"),
              ElementsAre("Main/IfThenElse/B: `AlwaysSuccess`, which is asked before it, never fails"));
  EXPECT_THAT(unreachedIn("<WhileDoElse><ScriptCondition code=\"1 > 2\"/><A/><B/></WhileDoElse>"),
              ElementsAre("Main/WhileDoElse/A: `ScriptCondition`, which is asked before it, never succeeds"));
  EXPECT_THAT(
      unreachedIn("<Switch2 variable=\"2\" case_1=\"1\" case_2=\"2.0\"><A/><B/><C/></Switch2>"),
      ElementsAre("Main/Switch2/A: `Switch2` always chooses `B`", "Main/Switch2/C: `Switch2` always chooses `B`"));
  EXPECT_THAT(
      unreachedIn("<Sequence><A _skipIf=\"true\"/><B _failureIf=\"1 == 1\"/></Sequence>"),
      ElementsAre("Main/Sequence/A: its `_skipIf` is always true", "Main/Sequence/B: its `_failureIf` is always true"));
  EXPECT_THAT(unreachedIn("<Inverter _while=\"false\"><A/></Inverter>"),
              ElementsAre("Main/Inverter: its `_while` is never true"));
  EXPECT_THAT(unreachedIn("<Precondition if=\"false\" else=\"SUCCESS\"><A/></Precondition>"),
              ElementsAre("Main/Precondition/A: the `if` of `Precondition` is never true"));
  EXPECT_THAT(unreachedIn("<Repeat num_cycles=\"0\"><A/></Repeat>"),
              ElementsAre("Main/Repeat/A: the num_cycles of `Repeat` is 0"));
  EXPECT_THAT(unreachedIn("<Fallback><Precondition if=\"true\"><AlwaysSuccess/></Precondition><A/></Fallback>"),
              ElementsAre("Main/Fallback/A: `Precondition` before it never fails"));
}

TEST(UnreachedNodes, AreNotThoseThatMayBeTicked) {
  for (const char* fine :
       {"<Fallback><A/><AlwaysSuccess/></Fallback>", "<Sequence><A/><B/></Sequence>",
        "<Fallback><AlwaysSuccess _skipIf=\"n == 1\" _post=\"n := 1\"/><A/></Fallback>",
        "<Fallback><AlwaysSuccess _failureIf=\"n == 1\" _post=\"n := 1\"/><A/></Fallback>",
        "<IfThenElse><A/><B/><C/></IfThenElse>", "<A _skipIf=\"false\" _while=\"1 &lt; 2\"/>",
        "<Precondition if=\"true\"><A/></Precondition>",
        "<Sequence><Script code=\"n := 0\"/><Repeat num_cycles=\"{n}\"><Script code=\"n += 1\"/></Repeat></Sequence>",
        "<Sequence><Script code=\"n := 1\"/><Switch2 variable=\"{n}\" case_1=\"1\" case_2=\"2\"><A/><B/><C/></Switch2>"
        "</Sequence>",
        "<Fallback><Timeout msec=\"5\"><AlwaysSuccess/></Timeout><A/></Fallback>",
        "<Sequence><Repeat num_cycles=\"3\"><A/></Repeat><B/></Sequence>",
        "<Fallback><Parallel><A/><AlwaysSuccess/></Parallel><B/></Fallback>",
        "<Sequence><SetBlackboard value=\"2\" output_key=\"n\"/><RetryUntilSuccessful num_attempts=\"{n}\">"
        "<AlwaysFailure/></RetryUntilSuccessful></Sequence>"})
    EXPECT_THAT(unreachedIn(fine), IsEmpty()) << fine;
}

TEST(Paths, CountSiblingsOfOneName) {
  Story story(
      "<Priority><A/><Sequence><B/><B/><Inverter name=\"not\"><B/></Inverter></Sequence><SubTree ID=\"S\"/>"
      "</Priority>",
      "<BehaviorTree ID=\"S\"><Sequence><A/></Sequence></BehaviorTree>");
  std::vector<std::string> paths;
  for (const NodeRecord& record : story.tree().nodes()) paths.push_back(story.tree().pathOf(record.node->id()));
  EXPECT_THAT(paths,
              ElementsAre("Main/Priority", "Main/Priority/A", "Main/Priority/Sequence", "Main/Priority/Sequence/B[1]",
                          "Main/Priority/Sequence/B[2]", "Main/Priority/Sequence/not", "Main/Priority/Sequence/not/B",
                          "Main/Priority/S", "Main/Priority/S/Sequence", "Main/Priority/S/Sequence/A"));
}

/// A random tree over A to E and the nodes that the judge knows.
std::string randomShape(std::mt19937& random, int depth, int& leaves) {
  static const char* const kControls[] = {"Sequence",           "Fallback",   "ReactiveSequence", "ReactiveFallback",
                                          "SequenceWithMemory", "Parallel",   "Priority",         "AsyncSequence",
                                          "IfThenElse",         "WhileDoElse"};
  static const char* const kDecorators[] = {"Inverter",
                                            "ForceSuccess",
                                            "ForceFailure",
                                            "Repeat num_cycles=\"2\"",
                                            "RetryUntilSuccessful num_attempts=\"2\"",
                                            "RunOnce",
                                            "Precondition if=\"false\" else=\"SUCCESS\"",
                                            "Precondition if=\"1 &lt; 2\" else=\"SKIPPED\"",
                                            "LoopInt queue=\"1;2\" if_empty=\"SKIPPED\"",
                                            "RunOnce then_skip=\"false\"",
                                            "Inverter _skipIf=\"1 &lt; 2\"",
                                            "KeepRunningUntilFailure"};
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const int kind = depth == 0 ? 0 : pick(4);
  if (kind == 0) {
    static const char* const kEndings[] = {"<AlwaysSuccess/>", "<AlwaysFailure/>"};
    if (pick(2) == 0 || leaves >= 5) return kEndings[pick(2)];
    return "<" + std::string(1, static_cast<char>('A' + leaves++)) + "/>";
  }
  if (kind == 1) {
    const std::string tag = kDecorators[pick(static_cast<int>(std::size(kDecorators)))];
    return "<" + tag + ">" + randomShape(random, depth - 1, leaves) + "</" + tag.substr(0, tag.find(' ')) + ">";
  }
  const std::string tag = kControls[pick(10)];
  std::string text = "<" + tag + ">";
  const int least = tag == "IfThenElse" || tag == "WhileDoElse" ? 2 : 1;
  for (int i = 0, n = least + pick(4 - least); i < n; ++i) text += randomShape(random, depth - 1, leaves);
  return text + "</" + tag + ">";
}

TEST(Outcomes, HoldInRandomTreesWithRandomAnswers) {
  std::mt19937 random(5);
  int judged_unreached = 0;
  for (int i = 0; i < 300; ++i) {
    int leaves = 0;
    const std::string inside = randomShape(random, 3, leaves);
    Story story(inside);
    ASSERT_TRUE(story.problems().empty()) << inside << toString(story.problems());
    const std::vector<Outcomes> outcomes = outcomesOf(story.tree());
    std::set<int> unreached;
    for (const Unreached& node : unreachedNodes(story.tree(), outcomes)) unreached.insert(node.node);
    judged_unreached += static_cast<int>(unreached.size());
    for (int tick = 0; tick < 60; ++tick) {
      for (const char* actor : {"A", "B", "C", "D", "E"})
        story.says(actor, std::array{"SUCCESS", "FAILURE", "RUNNING",
                                     "nothing"}[std::uniform_int_distribution<std::size_t>(0, 3)(random)]);
      story.tick();
      for (const NodeView& node : story.tree().view()) {
        const Outcomes& may = outcomes[static_cast<std::size_t>(node.id)];
        SCOPED_TRACE(inside + " node " + std::to_string(node.id) + " " + toString(node.status));
        EXPECT_TRUE(node.status != Status::kSuccess || may.success);
        EXPECT_TRUE(node.status != Status::kFailure || may.failure);
        EXPECT_TRUE(node.status != Status::kSkipped || may.skipped);
        EXPECT_TRUE(!unreached.contains(node.id) || !isActive(node.status));
      }
    }
  }
  EXPECT_GT(judged_unreached, 30) << "the random trees must have such nodes";
}

}  // namespace
}  // namespace swiftlet::tree::testing
