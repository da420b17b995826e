// Priority: every sentence of its header, tick by tick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kThree = "<Priority><A/><B/><C/></Priority>";

TEST(Priority, TheFirstChildThatIsNotSkippedControlsTheVehicle) {
  Story story(kThree);
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  EXPECT_EQ(story.view(), "Priority RUNNING, A SKIPPED, B RUNNING, C IDLE");
  EXPECT_THAT(story.switches(), ElementsAre("B takes over from nobody (B wants)"));
  EXPECT_EQ(story.tick(), "RUNNING: B");
  EXPECT_THAT(story.switches(), IsEmpty());
}

TEST(Priority, TicksTheNextChildInTheSameTickAfterASuccess) {
  Story story(kThree);
  story.says("A", "SUCCESS").says("B", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start C");
  EXPECT_THAT(story.switches(),
              ElementsAre("A takes over from nobody (A wants)", "C takes over from A (A ended with SUCCESS)"));
}

TEST(Priority, FailsAtAnyFailure) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start B");
}

TEST(Priority, AFailureAboveHaltsASuspendedChildBelow) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "nothing");
  story.tick();
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: C suspended, start A");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: A");
  EXPECT_EQ(story.view(), "Priority FAILURE, A FAILURE, B SKIPPED, C IDLE");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING: start C") << "not resumed";
}

TEST(Priority, IsSkippedWhenAllChildrenAre) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "nothing").says("C", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(Priority, EndsWithTheStatusOfItsLastChild) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "nothing").says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start C");
  story.says("C", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start C");
}

TEST(Priority, ASkippedLastChildKeepsTheSuccessAboveIt) {
  Story story(kThree);
  story.says("A", "SUCCESS").says("B", "nothing").says("C", "nothing");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

TEST(Priority, ALowerChildIsSuspendedAndNotReset) {
  Story story("<Priority><A/><Sequence><B/><C/></Sequence></Priority>");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start B, start C");
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: C suspended, start A");
  EXPECT_EQ(story.view(), "Priority RUNNING, A RUNNING, Sequence SUSPENDED, B SUCCESS, C SUSPENDED");
  EXPECT_EQ(story.tick(), "RUNNING: A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, resume C") << "in the same tick, and B is not asked again";
  EXPECT_THAT(story.switches(),
              ElementsAre("Sequence takes over from nobody (B wants)", "Sequence yields to A (A wants)",
                          "A takes over from Sequence (A wants)", "Sequence takes over from A (A ended with SUCCESS)"));
}

TEST(Priority, TheUpperChildStartsOnlyWhenTheLowerHasLetGo) {
  Story story("<Priority><A/><B/></Priority>");
  story.says("A", "nothing").says("B", "stops in 2");
  story.tick();
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: B suspending");
  EXPECT_EQ(story.view(), "Priority RUNNING, A IDLE, B RUNNING") << "B has the vehicle until it stopped";
  EXPECT_EQ(story.tick(), "RUNNING: B suspending");
  EXPECT_EQ(story.tick(), "RUNNING: B suspended, start A");
  EXPECT_THAT(story.switches(), ElementsAre("B takes over from nobody (B wants)", "B yields to A (A wants)",
                                            "A takes over from B (A wants)"));
}

TEST(Priority, TheLowerChildContinuesWhenTheUpperNoLongerAsks) {
  Story story("<Priority><A/><B/></Priority>");
  story.says("A", "nothing").says("B", "stops in 3");
  story.tick();
  story.switches();
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: B suspending");
  EXPECT_EQ(story.says("A", "nothing").tick(), "RUNNING: resume B");
  EXPECT_THAT(story.switches(), ElementsAre("B yields to A (A wants)", "B continues (A no longer asks)"));
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: B suspending") << "it has to stop all over again";
}

TEST(Priority, TheHighestOfSeveralRequestsWins) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "nothing").says("C", "stops in 1");
  story.tick();
  story.switches();
  EXPECT_EQ(story.says("B", "RUNNING").tick(), "RUNNING: C suspending");
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: C suspended, start A");
  EXPECT_THAT(story.switches(),
              ElementsAre("C yields to B (B wants)", "C yields to A (A wants)", "A takes over from C (A wants)"));
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: A, start B");
  EXPECT_EQ(story.says("A", "nothing").says("B", "SUCCESS").tick(), "RUNNING: B, resume C");
}

TEST(Priority, AHigherChildInterruptsAnInterruptingOne) {
  Story story(kThree);
  story.says("A", "nothing").says("B", "nothing");
  story.tick();
  EXPECT_EQ(story.says("B", "RUNNING").tick(), "RUNNING: C suspended, start B");
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: B suspended, start A");
  EXPECT_EQ(story.view(), "Priority RUNNING, A RUNNING, B SUSPENDED, C SUSPENDED");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: A, resume B");
  EXPECT_EQ(story.says("A", "nothing").says("B", "SUCCESS").tick(), "RUNNING: B, resume C");
}

TEST(Priority, ClocksStandStillWhileSuspended) {
  Story story(R"(<Priority><A/><Timeout msec="1000"><B/></Timeout></Priority>)");
  story.says("A", "nothing").says("B", "stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  EXPECT_EQ(story.says("A", "RUNNING").tick(600), "RUNNING: B suspending") << "600 ms are used";
  EXPECT_EQ(story.tick(5000), "RUNNING: B suspended, start A") << "letting go does not count either";
  EXPECT_EQ(story.tick(60'000), "RUNNING: A");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(1000), "RUNNING: A, resume B");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(399), "RUNNING: B");
  EXPECT_EQ(story.says("B", "stops in 0").tick(1), "FAILURE: B halted");
}

TEST(Priority, ADelayContinuesWhereItWas) {
  Story story(R"(<Priority><A/><Delay delay_msec="1000"><B/></Delay></Priority>)");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING");
  EXPECT_EQ(story.says("A", "RUNNING").tick(900), "RUNNING: start A");
  EXPECT_EQ(story.tick(60'000), "RUNNING: A");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: A");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(99), "RUNNING");
  EXPECT_EQ(story.tick(1), "RUNNING: start B");
}

TEST(Priority, AClockAboveItKeepsRunning) {
  Story story(R"(<Timeout msec="1000"><Priority><A/><B/></Priority></Timeout>)");
  story.says("A", "nothing");
  story.tick();
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: B suspended, start A");
  EXPECT_EQ(story.tick(900), "FAILURE: A halted") << "what is suspended has let go already";
}

TEST(Priority, CountsAreKeptWhileSuspended) {
  Story story(R"(<Priority><A/><Repeat num_cycles="2"><B/></Repeat></Priority>)");
  story.says("A", "nothing").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: start A") << "between two cycles nothing has to stop";
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: A, start B");
}

TEST(Priority, SuspendsEveryRunningChildOfAParallel) {
  Story story("<Priority><A/><Parallel><B/><C/></Parallel></Priority>");
  story.says("A", "nothing").says("B", "stops in 1").says("C", "stops in 2");
  story.tick();
  story.says("A", "RUNNING");
  EXPECT_EQ(story.tick(), "RUNNING: B suspending, C suspending");
  EXPECT_EQ(story.tick(), "RUNNING: B suspended, C suspending");
  EXPECT_EQ(story.tick(), "RUNNING: C suspended, start A");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: A, resume B, resume C");
}

TEST(Priority, ASuspendedPriorityStartsFromTheTopWhenResumed) {
  Story story("<Priority><A/><Priority name='inner'><B/><C/></Priority></Priority>");
  story.says("A", "nothing").says("B", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING: start C");
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: C suspended, start A");
  story.says("B", "RUNNING");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "RUNNING: A, start B");
  EXPECT_EQ(story.view(), "Priority RUNNING, A SUCCESS, inner RUNNING, B RUNNING, C SUSPENDED");
  story.says("A", "nothing");
  EXPECT_EQ(story.says("B", "SUCCESS").tick(), "RUNNING: B, resume C");
}

TEST(Priority, AHaltInProgressIsFinishedBeforeSuspending) {
  Story story(R"(<Priority><A/><Timeout msec="100"><B/></Timeout></Priority>)");
  story.says("A", "nothing").says("B", "stops in 2");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  EXPECT_EQ(story.tick(), "RUNNING: B halting") << "timed out";
  EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: B halting");
  EXPECT_EQ(story.tick(), "RUNNING: B halted, start A");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "FAILURE: A") << "the timeout stands";
}

TEST(Priority, HaltReleasesTheVehicleAndHaltsSuspendedChildren) {
  Story story("<Priority><A/><B/></Priority>");
  story.says("A", "nothing");
  story.tick();
  story.says("A", "RUNNING, stops in 1");
  story.tick();
  EXPECT_EQ(story.halt(), "not yet: A halting");
  EXPECT_EQ(story.halt(), "let go: A halted");
  EXPECT_EQ(story.view(), "Priority IDLE, A IDLE, B IDLE");
}

TEST(Priority, AsksThroughEveryKindOfNode) {
  for (const char* upper :
       {"<Sequence><A/><B/></Sequence>", "<Fallback><A/><B/></Fallback>",
        "<ReactiveSequence><A/><B/></ReactiveSequence>", "<ReactiveFallback><A/><B/></ReactiveFallback>",
        "<Parallel success_count='1'><A/><B/></Parallel>", "<Priority><A/><B/></Priority>", "<Inverter><A/></Inverter>",
        "<ForceSuccess><A/></ForceSuccess>", "<ForceFailure><A/></ForceFailure>",
        "<Repeat num_cycles='2'><A/></Repeat>", "<RetryUntilSuccessful num_attempts='2'><A/></RetryUntilSuccessful>",
        "<Timeout msec='5000'><A/></Timeout>", "<Delay delay_msec='0'><A/></Delay>", "<SubTree ID='Sub'/>"}) {
    Story story("<Priority>" + std::string(upper) + "<C/></Priority>", "<BehaviorTree ID='Sub'><A/></BehaviorTree>");
    ASSERT_EQ(toString(story.problems()), "") << upper;
    story.says("A", "nothing").says("B", "nothing");
    EXPECT_EQ(story.tick(), "RUNNING: start C") << upper;
    EXPECT_EQ(story.tick(), "RUNNING: C") << upper << ": asking must not disturb it";
    EXPECT_EQ(story.says("A", "RUNNING").tick(), "RUNNING: C suspended, start A") << upper;
  }
}

TEST(Priority, AChildThatIsNeverSkippedAlwaysAsks) {
  for (const char* upper : {"<Delay delay_msec='10'><A/></Delay>", "<Repeat num_cycles='0'><A/></Repeat>"}) {
    Story story("<Priority>" + std::string(upper) + "<C/></Priority>");
    story.says("A", "nothing");
    story.tick();
    EXPECT_EQ(story.switches().front().substr(0, 5), std::string(upper).substr(1, 5)) << upper;
  }
}

}  // namespace
}  // namespace swiftlet::tree::testing
