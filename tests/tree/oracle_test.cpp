// Random trees with random leaves: the engine answers and ticks exactly as a naive interpreter does. RC_PARAMS in the
// environment sets the number of trees:
//   RC_PARAMS="max_success=100000" build/release/test_tree --gtest_filter=Engine.EqualsTheNaiveInterpreter
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/tree/oracle.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using oracle::Answers;
using oracle::Bug;
using oracle::Condition;
using oracle::Oracle;
using oracle::Shape;
using oracle::Sharing;
using OracleStatus = oracle::Status;

constexpr int kLeaves = 5;
constexpr int kTicks = 25;

/// The counters that a tree has for itself begin at 0; the others are written as they are, so that it uses them all.
void share(Shape& shape, int sharing) {
  shape.number = sharing;
  const auto how = static_cast<Sharing>(sharing);
  const std::string first = how == Sharing::kNone ? "Zero" : how == Sharing::kOne ? "ZeroM" : "Touch";
  shape.children = {{.type = "Sequence", .children = {{.type = first}, shape.children[0]}}};
}

Shape randomShape(int depth) {
  Shape shape;
  static const std::vector<std::string> kControls = {
      "Sequence",           "Fallback",   "ReactiveSequence", "ReactiveFallback", "Parallel",      "Priority",
      "SequenceWithMemory", "IfThenElse", "WhileDoElse",      "AsyncSequence",    "AsyncFallback", "ParallelAll",
      "TryCatch",           "Switch2",    "Switch3",          "Switch4",          "Switch5",       "Switch6"};
  static const std::vector<std::string> kDecorators = {"Inverter",
                                                       "ForceSuccess",
                                                       "ForceFailure",
                                                       "Repeat",
                                                       "RetryUntilSuccessful",
                                                       "KeepRunningUntilFailure",
                                                       "RunOnce",
                                                       "Precondition",
                                                       "LoopDouble",
                                                       "LoopInt",
                                                       "LoopBool",
                                                       "LoopString",
                                                       "SkipUnlessUpdated",
                                                       "WaitValueUpdate",
                                                       "SubTree",
                                                       "SubTree",
                                                       "Delay",
                                                       "Timeout"};
  constexpr int kLeafWeight = 6;
  const auto controls = static_cast<int>(kControls.size()), decorators = static_cast<int>(kDecorators.size());
  const int kind = depth <= 0 ? 0 : *rc::gen::inRange(0, kLeafWeight + controls + decorators);
  shape.condition = *rc::gen::weightedElement<Condition>(
      {{12, Condition::kNone}, {1, Condition::kFailureIf}, {1, Condition::kSuccessIf}, {1, Condition::kSkipIf}});
  shape.counts = *rc::gen::weightedElement<bool>({{4, false}, {1, true}});
  shape.counter = *rc::gen::element<std::string>("n", "m");
  if (kind < kLeafWeight) {
    shape.type = *rc::gen::weightedElement<std::string>({{12, "Leaf"}, {1, "Sleep"}, {1, "WasEntryUpdated"}});
    shape.leaf = *rc::gen::inRange(0, kLeaves);
    shape.number = *rc::gen::inRange(0, 4);
    return shape;
  }
  const bool control = kind < kLeafWeight + controls;
  shape.type = control ? kControls[static_cast<std::size_t>(kind - kLeafWeight)]
                       : kDecorators[static_cast<std::size_t>(kind - kLeafWeight - controls)];
  const bool two = shape.type == "IfThenElse" || shape.type == "WhileDoElse" || shape.type == "TryCatch";
  const bool switches = shape.type.starts_with("Switch");
  const int children = switches ? shape.type.back() - '0' + 1 : control ? *rc::gen::inRange(two ? 2 : 1, 4) : 1;
  // A Switch has many children: they are smaller, so that a tree stays one that can be read.
  for (int i = 0; i < children; ++i) shape.children.push_back(randomShape(depth - (children > 4 ? 2 : 1)));
  const bool counted = shape.type == "Repeat" || shape.type == "RetryUntilSuccessful";
  const bool parallel = shape.type.starts_with("Parallel");
  shape.number = parallel ? *rc::gen::inRange(-children, children + 1) : *rc::gen::inRange(counted ? -1 : 0, 4);
  shape.number2 = parallel ? *rc::gen::inRange(-children, children + 1) : *rc::gen::inRange(0, 4);
  shape.leaf = *rc::gen::inRange(0, kLeaves);
  if (switches) shape.number = *rc::gen::inRange(0, children + 1);
  if (shape.type == "SubTree") share(shape, *rc::gen::inRange(0, 5));
  return shape;
}

Answers randomAnswers() {
  Answers answers;
  for (int i = 0; i < kLeaves; ++i)
    answers.push_back(*rc::gen::weightedElement<OracleStatus>({{4, OracleStatus::kRunning},
                                                               {3, OracleStatus::kSuccess},
                                                               {2, OracleStatus::kFailure},
                                                               {2, OracleStatus::kSkipped}}));
  return answers;
}

void letSay(Story& story, const Answers& answers) {
  for (int i = 0; i < kLeaves; ++i) {
    const OracleStatus answer = answers[static_cast<std::size_t>(i)];
    const std::string actor(1, static_cast<char>('A' + i));
    // A running stand-in that is asked to skip keeps running, as in the oracle.
    story.says(actor, answer == OracleStatus::kSkipped ? "RUNNING, nothing" : toString(answer));
  }
}

/// Only the ticks: the oracle knows nothing of letting go.
std::string ticksOnly(const std::string& told) {
  std::string kept = told.substr(0, told.find(':'));
  for (std::size_t at = told.find(": "); at != std::string::npos;) {
    const std::size_t end = told.find(", ", at + 2);
    const std::string word = told.substr(at + 2, end == std::string::npos ? end : end - at - 2);
    if (!word.ends_with("ed")) kept += " " + word;
    at = end;
  }
  return kept;
}

std::string oracleTick(Oracle& oracle, const Shape& shape, const Answers& answers) {
  std::vector<std::string> log;
  std::string text = toString(oracle.tick(shape, answers, log));
  for (const std::string& entry : log) text += " " + entry;
  return text;
}

/// The counter of the conditions is set before the shape.
Shape withCounter(Shape shape) { return {.type = "Sequence", .children = {{.type = "Zero"}, std::move(shape)}}; }

RC_GTEST_PROP(Engine, EqualsTheNaiveInterpreter, ()) {
  const Shape shape = withCounter(randomShape(4));
  std::string trees;
  const std::string xml = toXml(shape, trees);
  Story story(xml, trees);
  RC_LOG() << xml << "\n" << trees << toString(story.problems()) << "\n";
  RC_ASSERT(story.problems().empty());
  Oracle oracle;
  for (int i = 0; i < kTicks; ++i) {
    const Answers answers = randomAnswers();
    letSay(story, answers);
    RC_ASSERT(ticksOnly(story.tick()) == oracleTick(oracle, shape, answers));
  }
}

/// Leaves that count and ask, as many as there are answers.
std::vector<Shape> countingLeaves() {
  std::vector<Shape> leaves;
  for (int i = 0; i < kLeaves; ++i)
    leaves.push_back({.type = "Leaf",
                      .leaf = i,
                      .condition = *rc::gen::element(Condition::kNone, Condition::kFailureIf, Condition::kSkipIf),
                      .counts = true,
                      .counter = *rc::gen::element<std::string>("n", "m")});
  return leaves;
}

/// Counts before, inside and behind a SubTree, so that it shows whose counters they are.
Shape countedSubTree() {
  Shape inner{.type = "SubTree", .children = {{.type = "Sequence", .children = countingLeaves()}}};
  share(inner, *rc::gen::inRange(0, 5));
  Shape all{.type = "Sequence", .children = countingLeaves()};
  all.children.insert(all.children.begin() + 2, std::move(inner));
  return all;
}

/// True when a tree is found on which the engine and the wrong oracle differ.
bool isNoticed(Bug bug, const std::string& type) {
  bool noticed = false;
  rc::detail::TestParams params;
  // Some bugs show in one tree of a thousand; one is enough.
  params.maxSuccess = 30000;
  params.disableShrinking = true;
  rc::detail::checkTestable(
      [&] {
        if (noticed) return;
        Shape shape = randomShape(3);
        shape.type = type;
        if (shape.children.empty()) shape.children = {randomShape(2), randomShape(2)};
        const bool decorator = type.starts_with("Loop") || type == "Delay" || type == "Inverter" ||
                               type.find("Update") != std::string::npos;
        if (decorator) shape.children.resize(1);
        if (type == "Switch2") shape.children.resize(3, shape.children[0]);
        if (type == "SubTree") shape = countedSubTree();
        shape = withCounter(shape);
        std::string trees;
        const std::string xml = toXml(shape, trees);
        Story story(xml, trees);
        if (!story.problems().empty()) return;
        Oracle oracle(bug);
        for (int i = 0; i < kTicks && !noticed; ++i) {
          const Answers answers = randomAnswers();
          letSay(story, answers);
          noticed = ticksOnly(story.tick()) != oracleTick(oracle, shape, answers);
        }
      },
      rc::detail::TestMetadata{}, params);
  return noticed;
}

TEST(Engine, PlantedBugsAreNoticed) {
  EXPECT_TRUE(isNoticed(Bug::kSequenceRestarts, "Sequence"));
  EXPECT_TRUE(isNoticed(Bug::kPriorityResets, "Priority"));
  EXPECT_TRUE(isNoticed(Bug::kReactiveRemembers, "ReactiveSequence"));
  EXPECT_TRUE(isNoticed(Bug::kMemoryForgets, "SequenceWithMemory"));
  EXPECT_TRUE(isNoticed(Bug::kLoopStartsAnew, "LoopString"));
  EXPECT_TRUE(isNoticed(Bug::kClockRunsTwice, "Delay"));
  EXPECT_TRUE(isNoticed(Bug::kConditionsIgnored, "Inverter"));
  EXPECT_TRUE(isNoticed(Bug::kNewsForgotten, "SkipUnlessUpdated"));
  EXPECT_TRUE(isNoticed(Bug::kNewsNotTaken, "WaitValueUpdate"));
  EXPECT_TRUE(isNoticed(Bug::kSwitchSticks, "Switch2"));
  EXPECT_TRUE(isNoticed(Bug::kScopesShared, "SubTree"));
  EXPECT_TRUE(isNoticed(Bug::kSwapIgnored, "SubTree"));
  EXPECT_TRUE(isNoticed(Bug::kElementLost, "LoopDouble"));
}

}  // namespace
}  // namespace swiftlet::tree::testing
