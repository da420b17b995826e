// Nodes with memory, choices, loops and news, tick by tick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

TEST(SequenceWithMemory, StartsAgainWithTheChildThatFailed) {
  Story story("<SequenceWithMemory><A/><B/></SequenceWithMemory>");
  story.says("A", "SUCCESS").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "a child that starts and ends in a tick ends that tick";
  EXPECT_EQ(story.tick(), "FAILURE: start B");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start B");
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "forgotten after the last";
}

TEST(SequenceWithMemory, CountsWhatWasSkippedSinceItStarted) {
  Story story("<SequenceWithMemory><A/><B/></SequenceWithMemory>");
  story.says("A", "nothing").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start B");
  story.says("B", "nothing");
  EXPECT_EQ(story.tick(), "SUCCESS") << "of the two it skipped only one since";
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(SequenceWithMemory, StartsAgainWithTheChildThatWasHalted) {
  Story story("<SequenceWithMemory><A/><B/></SequenceWithMemory>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, start B");
  EXPECT_EQ(story.halt(), "let go: B halted");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
}

TEST(AsyncSequence, StartsOneChildATick) {
  Story story("<AsyncSequence><A/><B/><C/></AsyncSequence>");
  story.says("A", "SUCCESS").says("B", "SUCCESS").says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  EXPECT_EQ(story.tick(), "SUCCESS: start C");
}

TEST(AsyncFallback, StartsOneChildATick) {
  Story story("<AsyncFallback><A/><B/></AsyncFallback>");
  story.says("A", "FAILURE").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "FAILURE: start B");
}

TEST(ParallelAll, WaitsForAllAndCountsTheFailures) {
  Story story("<ParallelAll max_failures=\"2\"><A/><B/><C/></ParallelAll>");
  story.says("A", "FAILURE").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: C");
  Story strict("<ParallelAll><A/><B/></ParallelAll>");
  strict.says("A", "FAILURE");
  EXPECT_EQ(strict.tick(), "RUNNING: start A, start B");
  strict.says("B", "SUCCESS");
  EXPECT_EQ(strict.tick(), "FAILURE: B");
  EXPECT_THAT(problemsInside("<ParallelAll max_failures=\"3\"><A/><B/></ParallelAll>"),
              ElementsAre(At("3:14 ParallelAll", "tree.count-unreachable", "max_failures")));
}

TEST(IfThenElse, AsksOnce) {
  Story story("<IfThenElse><A/><B/><C/></IfThenElse>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: B");
  story.says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: B");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start C");
  Story two("<IfThenElse><A/><B/></IfThenElse>");
  two.says("A", "FAILURE");
  EXPECT_EQ(two.tick(), "FAILURE: start A");
  EXPECT_THAT(problemsInside("<IfThenElse><A/></IfThenElse>"),
              ElementsAre(At("3:1 IfThenElse", "tree.children-count", "2 or 3")));
}

TEST(WhileDoElse, AsksAtEveryTickAndHaltsWhatRan) {
  Story story("<WhileDoElse><A/><B/><C/></WhileDoElse>");
  story.says("A", "SUCCESS").says("B", "RUNNING, stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A, B halting");
  EXPECT_EQ(story.tick(), "RUNNING: B halted, start A, start C");
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A, C");
  Story two("<WhileDoElse><A/><B/></WhileDoElse>");
  two.says("A", "SUCCESS");
  EXPECT_EQ(two.tick(), "RUNNING: start A, start B");
  two.says("A", "FAILURE");
  EXPECT_EQ(two.tick(), "FAILURE: start A, B halted");
}

TEST(Switch, RunsTheChildOfTheCase) {
  Story story(
      "<Sequence><Script code=\"n := 2\"/><Switch2 variable=\"{n}\" case_1=\"1\" case_2=\"2.0\"><A/><B/><C/></Switch2>"
      "</Sequence>");
  EXPECT_EQ(story.tick(), "RUNNING: start B");
  Story other("<Switch2 variable=\"left\" case_1=\"right\" case_2=\"up\"><A/><B/><C/></Switch2>");
  EXPECT_EQ(other.tick(), "RUNNING: start C");
  EXPECT_THAT(problemsInside("<Switch2 variable=\"1\" case_1=\"1\" case_2=\"2\"><A/><B/></Switch2>"),
              ElementsAre(At("3:1 Switch2", "tree.children-count", "exactly 3")));
}

TEST(Switch, WithoutAVariableRunsTheLastChildAndPassesOverCasesThatAreNotSet) {
  const std::string unset = "<Fallback><AlwaysFailure _onSuccess=\"n := 1\"/>";
  EXPECT_EQ(
      Story(unset + "<Switch2 variable=\"{n}\" case_1=\"1\" case_2=\"2\"><A/><B/><C/></Switch2></Fallback>").tick(),
      "RUNNING: start C");
  EXPECT_EQ(
      Story(unset + "<Switch2 variable=\"2\" case_1=\"{n}\" case_2=\"2\"><A/><B/><C/></Switch2></Fallback>").tick(),
      "RUNNING: start B");
  EXPECT_EQ(Story("<Switch2 case_2=\"2\"><A/><B/><C/></Switch2>").tick(), "RUNNING: start C");
}

TEST(Switch, ComparesNumbersTruthValuesAndConstants) {
  const auto chosen = [](const std::string& script, const std::string& cases) {
    return Story("<Sequence><Script code=\"" + script + "\"/><Switch2 variable=\"{x}\" " + cases +
                 "><A/><B/><C/></Switch2></Sequence>")
        .tick();
  };
  EXPECT_EQ(chosen("x := true", "case_1='false' case_2='true'"), "RUNNING: start B");
  EXPECT_EQ(chosen("x := true", "case_1='1' case_2='true'"), "RUNNING: start A");
  EXPECT_EQ(chosen("x := 0.1 + 0.2", "case_1='3' case_2='0.3'"), "RUNNING: start B");
  Registry registry = Registry::standard();
  registry.addConstant("RED", 7);
  Story story(file("<Sequence><Script code=\"x := RED\"/><Switch2 variable=\"{x}\" case_1=\"6\" case_2=\"RED\"><A/><B/>"
                   "<C/></Switch2></Sequence>"),
              registry);
  EXPECT_EQ(story.tick(), "RUNNING: start B");
}

TEST(Switch, HaltsTheChildOfTheFormerCase) {
  Story story(
      "<Sequence><Script code=\"n := 1\"/><Parallel><Switch2 variable=\"{n}\" case_1=\"1\" case_2=\"2\">"
      "<A/><B/><AlwaysSuccess/></Switch2><Sequence><C/><Script code=\"n = 2\"/><D/></Sequence></Parallel>"
      "</Sequence>");
  story.says("A", "RUNNING, stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start C");
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: A, C, start D");
  EXPECT_EQ(story.tick(), "RUNNING: A halting, D");
  EXPECT_EQ(story.tick(), "RUNNING: A halted, start B, D");
}

TEST(KeepRunningUntilFailure, EndsOnlyThen) {
  Story story("<KeepRunningUntilFailure><A/></KeepRunningUntilFailure>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "RUNNING") << "asked again at the next tick";
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start A");
}

TEST(RunOnce, IsSkippedAfterwards) {
  Story story("<RunOnce><A/></RunOnce>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: A");
  EXPECT_EQ(story.tick(), "SKIPPED");
  Story same("<RunOnce then_skip=\"false\"><A/></RunOnce>");
  same.says("A", "FAILURE");
  EXPECT_EQ(same.tick(), "FAILURE: start A");
  EXPECT_EQ(same.tick(), "FAILURE");
}

TEST(Precondition, AsksWhileTheChildIsNotUnderWay) {
  Story story(
      "<Sequence><Script code=\"n := 0\"/><Precondition if=\"n == 0\" else=\"SKIPPED\"><A/></Precondition></Sequence>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  Story other("<Precondition if=\"1 > 2\" else=\"SUCCESS\"><A/></Precondition>");
  EXPECT_EQ(other.tick(), "SUCCESS");
  EXPECT_EQ(Story("<Priority><Precondition if=\"false\" else=\"SKIPPED\"><A/></Precondition><B/></Priority>").tick(),
            "RUNNING: start B");
  EXPECT_THAT(problemsInside("<Precondition if=\"true\" else=\"NO\"><A/></Precondition>"),
              ElementsAre(At("3:25 Precondition.else", "tree.value-type", "`NO`")));
}

TEST(Loop, RunsTheChildOnceForEachElement) {
  Story story(
      "<LoopInt queue=\"3;4\" value=\"{n}\"><Sequence><A/><ScriptCondition code=\"n >= 3\"/></Sequence></LoopInt>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "the queue of the file starts anew";
  EXPECT_THAT(problemsInside("<LoopString queue=\"1\" if_empty=\"never\"><A/></LoopString>"),
              ElementsAre(At("3:23 LoopString.if_empty", "tree.value-type", "`never`")));
  Story empty("<LoopString queue=\"\" if_empty=\"FAILURE\" value=\"{n}\"><A/></LoopString>");
  EXPECT_EQ(empty.tick(), "FAILURE");
}

TEST(Loop, ReadsTheEntryAnewAtEachStart) {
  Story story(
      "<Sequence><SetBlackboard value=\"1.5;2\" output_key=\"q\"/><Repeat num_cycles=\"2\"><LoopDouble queue=\"{q}\" "
      "value=\"{n}\"><A/></LoopDouble></Repeat><ScriptCondition code=\"q == '1.5;2'\"/></Sequence>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "the second cycle";
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Loop, ANumberIsAQueueOfOneAndTheValueMayBeLeftOut) {
  Story story("<Sequence><Script code=\"q := 5\"/><LoopInt queue=\"{q}\"><A/></LoopInt></Sequence>");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(Loop, ElementsThatDoNotConvertAreFoundBeforeTheFirstTick) {
  EXPECT_THAT(problemsInside("<LoopInt queue=\"1;x\" value=\"{n}\"><A/></LoopInt>"),
              ElementsAre(At("3:10 LoopInt.queue", "tree.list-element", "`x`", "`1;x`")));
  EXPECT_THAT(problemsInside("<Sequence><SetBlackboard value=\"1;true\" output_key=\"q\"/><LoopInt queue=\"{q}\"><A/>"
                             "</LoopInt></Sequence>"),
              ElementsAre(At("3:26 value", "tree.list-element", "`true`", "`1;true`", "{q}")));
  EXPECT_THAT(problemsInside("<LoopBool queue=\"1;True;false\"><A/></LoopBool>"), ElementsAre());
  // What only the flight knows fails with the reason.
  Story late("<Sequence><Script code=\"q := '1;' .. 'x'\"/><LoopInt queue=\"{q}\"><A/></LoopInt></Sequence>");
  late.says("A", "SUCCESS");
  EXPECT_EQ(late.tick(), "RUNNING: start A");
  EXPECT_EQ(late.tick(), "FAILURE");
  EXPECT_THAT(late.failures(), ElementsAre("LoopInt: the element `x` is not a whole number"));
  Story unset("<Fallback><AlwaysFailure _onSuccess=\"q := '1'\"/><LoopInt queue=\"{q}\"><A/></LoopInt></Fallback>");
  EXPECT_EQ(unset.tick(), "FAILURE");
  EXPECT_THAT(unset.failures(), ElementsAre("LoopInt: port queue: the entry {q} is not set"));
}

TEST(Numbers, OfScriptsAreTimesInTheUnitOfThePort) {
  Story story(
      "<Sequence><Script code=\"t := 250; d := 0.1 * 1000\"/><Sleep msec=\"{t}\"/><Delay delay_msec=\"{d}\"><Timeout "
      "msec=\"{t}\"><A/></Timeout></Delay></Sequence>");
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.tick(), "RUNNING");
  EXPECT_EQ(story.tick(249), "RUNNING");
  EXPECT_EQ(story.tick(1), "RUNNING");
  EXPECT_EQ(story.tick(100), "RUNNING: start A");
  EXPECT_EQ(story.tick(249), "RUNNING: A");
  EXPECT_EQ(story.tick(1), "FAILURE: A halted");
  Story loop("<LoopInt queue=\"100;300\" value=\"{t}\"><Sequence><Sleep msec=\"{t}\"/><A/></Sequence></LoopInt>");
  ASSERT_EQ(toString(loop.problems()), "");
  EXPECT_EQ(loop.tick(), "RUNNING");
  EXPECT_EQ(loop.tick(100), "RUNNING: start A");
  Story negative("<Sequence><Script code=\"t := -1\"/><Sleep msec=\"{t}\"/></Sequence>");
  EXPECT_EQ(negative.tick(), "FAILURE");
}

TEST(EntryUpdated, NoticesEachWriteOnce) {
  Story story(
      "<Sequence><Script code=\"n := 1\"/><Repeat num_cycles=\"3\"><Sequence><ForceSuccess><Sequence>"
      "<WasEntryUpdated entry=\"{n}\"/><A/></Sequence></ForceSuccess><B/></Sequence></Repeat></Sequence>");
  story.says("A", "SUCCESS").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(story.tick(), "RUNNING: start B") << "not written since";
  Story wait(
      "<Sequence><SetBlackboard value=\"1\" output_key=\"n\"/><WaitValueUpdate entry=\"{n}\"><A/></WaitValueUpdate>"
      "<WaitValueUpdate entry=\"{n}\" name=\"again\"><B/></WaitValueUpdate></Sequence>");
  wait.says("A", "SUCCESS").says("B", "SUCCESS");
  EXPECT_EQ(wait.tick(), "SUCCESS: start A, start B") << "each node has its own memory";
  Story skip(
      "<Repeat num_cycles=\"2\"><Sequence><ForceSuccess><RunOnce><SetBlackboard value=\"1\" output_key=\"n\"/>"
      "</RunOnce></ForceSuccess><SkipUnlessUpdated entry=\"{n}\"><A/></SkipUnlessUpdated><B/></Sequence></Repeat>");
  skip.says("A", "SUCCESS").says("B", "SUCCESS");
  EXPECT_EQ(skip.tick(), "RUNNING: start A, start B");
  EXPECT_EQ(skip.tick(), "SUCCESS: start B");
  Story bare("<Sequence><Script code=\"n := 1\"/><WasEntryUpdated entry=\"n\"/><A/></Sequence>");
  EXPECT_EQ(bare.tick(), "RUNNING: start A") << "a name without braces";
  EXPECT_THAT(problemsInside("<WasEntryUpdated entry=\"{}\"/>"),
              ElementsAre(At("3:18 WasEntryUpdated.entry", "tree.not-an-entry", "`{}`")));
}

TEST(TryCatch, RunsTheLastChildWhenOneFails) {
  Story story("<TryCatch><A/><B/><C/></TryCatch>");
  story.says("A", "SUCCESS").says("B", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start B, start C");
  story.says("C", "SUCCESS");
  EXPECT_EQ(story.tick(), "FAILURE: C");
  story.says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A, start B");
}

TEST(TryCatch, RunsTheLastChildOnAHaltIfWanted) {
  Story story("<TryCatch catch_on_halt=\"true\"><A/><B/></TryCatch>");
  story.says("A", "RUNNING, stops in 1").says("B", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.halt(), "not yet: A halting");
  EXPECT_EQ(story.halt(), "let go: A halted, start B");
  Story plain("<TryCatch><A/><B/></TryCatch>");
  EXPECT_EQ(plain.tick(), "RUNNING: start A");
  EXPECT_EQ(plain.halt(), "let go: A halted");
}

TEST(Sleep, TakesItsTime) {
  Story story("<Sequence><Sleep msec=\"250\"/><A/></Sequence>");
  EXPECT_EQ(story.tick(), "RUNNING");
  EXPECT_EQ(story.tick(249), "RUNNING");
  EXPECT_EQ(story.tick(1), "RUNNING: start A");
}

TEST(UnsetBlackboard, TakesTheValueAway) {
  Story story(
      "<Sequence><Script code=\"n := 1\"/><UnsetBlackboard key=\"n\"/><ScriptCondition code=\"n == 1\"/></Sequence>");
  EXPECT_EQ(story.tick(), "FAILURE");
  EXPECT_THAT(story.failures(), ElementsAre("ScriptCondition: code: the entry {n} is not set"));
}

TEST(TestNode, AnswersWhatItIsToldTo) {
  Story story(
      "<Sequence><TestNode async_delay_msec=\"100\" success_script=\"n := 3\"/><ScriptCondition code=\"n == "
      "3\"/></Sequence>");
  EXPECT_EQ(story.tick(), "RUNNING");
  EXPECT_EQ(story.tick(100), "SUCCESS");
  EXPECT_EQ(Story("<TestNode return_status=\"FAILURE\"/>").tick(), "FAILURE");
  EXPECT_EQ(Story("<TestNode return_status=\"SKIPPED\"/>").tick(), "SKIPPED");
}

}  // namespace
}  // namespace swiftlet::tree::testing
