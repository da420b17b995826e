// Sequence, Fallback, their reactive variants and Parallel, tick by tick.
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

TEST(Sequence, ContinuesWithTheRunningChildAndStartsTheNextInTheSameTick) {
  Story story("<Sequence><A/><B/></Sequence>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, start B");
  EXPECT_EQ(story.tick(), "RUNNING: B") << "a child that ended is not asked again";
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: B");
  EXPECT_EQ(story.view(), "Sequence SUCCESS, A SUCCESS, B SUCCESS");
}

TEST(Sequence, EndsAtTheFirstFailureAndRestarts) {
  Story story("<Sequence><A/><B/><C/></Sequence>");
  story.says("A", "SUCCESS").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start A, start B");
  EXPECT_EQ(story.view(), "Sequence FAILURE, A SUCCESS, B FAILURE, C IDLE");
  EXPECT_EQ(story.tick(), "FAILURE: start A, start B");
}

TEST(Sequence, SkipsChildrenAndIsSkippedWhenAllAre) {
  Story story("<Sequence><A/><B/></Sequence>");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start B");
  story.says("B", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
  EXPECT_EQ(story.view(), "Sequence SKIPPED, A SKIPPED, B SKIPPED");
}

TEST(Sequence, DoesNotTickASkippedChildAgain) {
  Story story("<Sequence><A/><B/></Sequence>");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: B");
}

TEST(Sequence, HaltStopsOnlyTheRunningChildAndResets) {
  Story story("<Sequence><A/><B/></Sequence>");
  story.says("A", "SUCCESS").says("B", "stops in 2");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(story.halt(), "not yet: B halting");
  EXPECT_EQ(story.halt(), "not yet: B halting");
  EXPECT_EQ(story.view(), "Sequence RUNNING, A SUCCESS, B RUNNING") << "it has not let go yet";
  EXPECT_EQ(story.halt(), "let go: B halted");
  EXPECT_EQ(story.view(), "Sequence IDLE, A IDLE, B IDLE");
  EXPECT_EQ(story.halt(), "let go") << "nothing to let go";
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
}

TEST(Sequence, TickedWhileBeingHaltedFinishesThatFirst) {
  Story story("<Sequence><A/></Sequence>");
  story.says("A", "stops in 1");
  story.tick();
  EXPECT_EQ(story.halt(), "not yet: A halting");
  EXPECT_EQ(story.tick(), "RUNNING: A halted, start A");
}

TEST(Fallback, EndsAtTheFirstSuccess) {
  Story story("<Fallback><A/><B/><C/></Fallback>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "FAILURE").says("B", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: A, start B");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: B");
  EXPECT_EQ(story.view(), "Fallback SUCCESS, A FAILURE, B SUCCESS, C IDLE");
}

TEST(Fallback, FailsAfterTheLastAndIsSkippedWhenAllAre) {
  Story story("<Fallback><A/><B/></Fallback>");
  story.says("A", "FAILURE").says("B", "nothing");
  EXPECT_EQ(story.tick(), "FAILURE: start A");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(ReactiveSequence, TicksTheFirstChildEveryTime) {
  Story story("<ReactiveSequence><A/><B/></ReactiveSequence>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A, B");
}

TEST(ReactiveSequence, HaltsTheRunningChildBeforeAFailedConditionFailsIt) {
  Story story("<ReactiveSequence><A/><B/></ReactiveSequence>");
  story.says("A", "SUCCESS").says("B", "stops in 2");
  story.tick();
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B halting");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: B halting") << "the failure stands, whatever A would say now";
  EXPECT_EQ(story.tick(), "FAILURE: B halted");
  EXPECT_EQ(story.view(), "ReactiveSequence FAILURE, A FAILURE, B IDLE");
}

TEST(ReactiveSequence, ARunningEarlierChildHaltsALaterOne) {
  Story story("<ReactiveSequence><A/><B/></ReactiveSequence>");
  story.says("A", "SUCCESS").says("B", "stops in 1");
  story.tick();
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B halting");
  EXPECT_EQ(story.tick(), "RUNNING: B halted, A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, start B") << "B restarts";
}

TEST(ReactiveSequence, IsSkippedWhenAllAreEvenAfterRunning) {
  Story story("<ReactiveSequence><A/><B/></ReactiveSequence>");
  story.says("A", "nothing").says("B", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: B");
  story.says("B", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(ReactiveFallback, PrefersTheEarliestChildThatDoesNotFail) {
  Story story("<ReactiveFallback><A/><B/></ReactiveFallback>");
  story.says("A", "FAILURE").says("B", "stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B halting");
  EXPECT_EQ(story.tick(), "SUCCESS: B halted");
}

TEST(ReactiveFallback, FailsWhenAllFailAndIsSkippedWhenAllAre) {
  Story story("<ReactiveFallback><A/><B/></ReactiveFallback>");
  story.says("A", "FAILURE").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start A, start B");
  story.says("A", "nothing").says("B", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(ReactiveFallback, ARunningEarlierChildHaltsALaterOne) {
  Story story("<ReactiveFallback><A/><B/></ReactiveFallback>");
  story.says("A", "FAILURE").says("B", "stops in 1");
  story.tick();
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B halting");
  EXPECT_EQ(story.tick(), "RUNNING: B halted, A");
}

TEST(Parallel, AllMustSucceedByDefault) {
  Story story("<Parallel><A/><B/><C/></Parallel>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: B, C") << "a child that ended is not ticked again";
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: C");
}

TEST(Parallel, OneFailureHaltsTheOthers) {
  Story story("<Parallel><A/><B/></Parallel>");
  story.says("A", "stops in 1");
  story.tick();
  story.says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: A, B, A halting");
  EXPECT_EQ(story.tick(), "FAILURE: A halted");
}

TEST(Parallel, SucceedsAtTheGivenNumberOfSuccesses) {
  Story story(R"(<Parallel success_count="2" failure_count="2"><A/><B/><C/></Parallel>)");
  story.says("A", "FAILURE").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: C");
}

TEST(Parallel, FailsAsSoonAsTooFewAreLeft) {
  Story story(R"(<Parallel success_count="2" failure_count="3"><A/><B/><C/></Parallel>)");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  story.says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: B, C halted") << "C cannot make it two any more";
}

TEST(Parallel, SkippedCountsAsSuccessWhereAllMustSucceed) {
  Story story("<Parallel><A/><B/></Parallel>");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start B");
  story.says("B", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(Parallel, TicksSkippedChildrenAgain) {
  Story story(R"(<Parallel success_count="2"><A/><B/></Parallel>)");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

}  // namespace
}  // namespace swiftlet::tree::testing
