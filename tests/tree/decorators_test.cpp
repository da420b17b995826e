// Decorators, leaves of the engine, subtrees and blackboard entries, tick by tick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

TEST(Inverter, SwapsSuccessAndFailure) {
  Story story("<Inverter><A/></Inverter>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "FAILURE: A");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(Force, GivesTheResultOfItsName) {
  Story success("<ForceSuccess><A/></ForceSuccess>"), failure("<ForceFailure><A/></ForceFailure>");
  for (Story* story : {&success, &failure}) EXPECT_EQ(story->tick(), "RUNNING: start A");
  for (const char* end : {"SUCCESS", "FAILURE"}) {
    EXPECT_EQ(success.says("A", end).tick().substr(0, 7), "SUCCESS");
    EXPECT_EQ(failure.says("A", end).tick().substr(0, 7), "FAILURE");
  }
  for (Story* story : {&success, &failure}) EXPECT_EQ(story->says("A", "nothing").tick(), "SKIPPED");
}

TEST(Repeat, CountsSuccessesWithAtMostOneCyclePerTick) {
  Story story(R"(<Repeat num_cycles="3"><A/></Repeat>)");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "counts anew";
}

TEST(Repeat, ACycleThatEndsStartsTheNextInTheSameTick) {
  Story story(R"(<Repeat num_cycles="2"><A/></Repeat>)");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: A, start A");
}

TEST(Repeat, EndsAtAFailureAndPassesOnSkipped) {
  Story story(R"(<Repeat num_cycles="3"><A/></Repeat>)");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start A");
  story.says("A", "nothing");
  EXPECT_EQ(story.tick(), "SKIPPED");
}

TEST(Repeat, MinusOneRepeatsForEverAndZeroNever) {
  Story forever(R"(<Repeat num_cycles="-1"><A/></Repeat>)"), never(R"(<Repeat num_cycles="0"><A/></Repeat>)");
  forever.says("A", "SUCCESS");
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(forever.tick(), "RUNNING: start A");
  EXPECT_EQ(never.tick(), "SUCCESS");
}

TEST(Repeat, ReadsTheNumberOnceATick) {
  Story raised(
      R"(<Sequence><Script code="n := 1"/><Repeat num_cycles="{n}"><Script code="n += 1"/></Repeat></Sequence>)");
  EXPECT_EQ(raised.tick(), "SUCCESS");
  Story lowered(
      R"(<Sequence><Script code="n := 3"/><Repeat num_cycles="{n}"><A _onSuccess="n = 1"/></Repeat></Sequence>)");
  lowered.says("A", "SUCCESS");
  EXPECT_EQ(lowered.tick(), "RUNNING: start A");
  EXPECT_EQ(lowered.tick(), "SUCCESS");
}

TEST(Retry, CountsFailures) {
  Story story(R"(<RetryUntilSuccessful num_attempts="2"><A/></RetryUntilSuccessful>)");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "FAILURE: start A");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

TEST(Retry, ReadsTheNumberAgainAfterEachAttempt) {
  Story story(
      R"(<Sequence><Script code="n := 5"/><RetryUntilSuccessful num_attempts="{n}"><A _onFailure="n = 1"/></RetryUntilSuccessful></Sequence>)");
  story.says("A", "FAILURE");
  EXPECT_EQ(story.tick(), "FAILURE: start A");
}

TEST(Clocks, OfDelayAndTimeoutStartAnewAfterSkipped) {
  Story delay(R"(<Delay delay_msec="1000"><A/></Delay>)");
  delay.says("A", "nothing");
  EXPECT_EQ(delay.tick(), "RUNNING");
  EXPECT_EQ(delay.tick(1000), "SKIPPED");
  delay.says("A", "RUNNING");
  EXPECT_EQ(delay.tick(), "RUNNING") << "waits again";
  Story timeout(R"(<Timeout msec="1000"><A/></Timeout>)");
  timeout.says("A", "nothing");
  EXPECT_EQ(timeout.tick(), "SKIPPED");
  timeout.says("A", "RUNNING");
  EXPECT_EQ(timeout.tick(900), "RUNNING: start A");
  EXPECT_EQ(timeout.tick(900), "RUNNING: A");
  EXPECT_EQ(timeout.tick(100), "FAILURE: A halted");
}

TEST(Retry, ZeroNeverTicksAndSkippedIsPassedOn) {
  Story zero(R"(<RetryUntilSuccessful num_attempts="0"><A/></RetryUntilSuccessful>)");
  EXPECT_EQ(zero.tick(), "FAILURE");
  Story story(R"(<RetryUntilSuccessful num_attempts="2"><A/></RetryUntilSuccessful>)");
  EXPECT_EQ(story.says("A", "nothing").tick(), "SKIPPED");
}

TEST(Timeout, HaltsTheChildWhenTheTimeIsOver) {
  Story story(R"(<Timeout msec="1000"><A/></Timeout>)");
  story.says("A", "stops in 1");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(999), "RUNNING: A");
  EXPECT_EQ(story.tick(1), "RUNNING: A halting") << "not ticked once more";
  EXPECT_EQ(story.tick(), "FAILURE: A halted");
  EXPECT_THAT(story.failures(), ElementsAre("Timeout: timed out after 1 s"));
  EXPECT_EQ(story.tick(), "RUNNING: start A") << "the clock restarts";
}

TEST(Timeout, PassesOnAnAnswerInTime) {
  Story story(R"(<Timeout msec="1000"><A/></Timeout>)");
  story.tick();
  EXPECT_EQ(story.says("A", "SUCCESS").tick(500), "SUCCESS: A");
  EXPECT_EQ(story.says("A", "FAILURE").tick(5000), "FAILURE: start A");
  EXPECT_EQ(story.says("A", "nothing").tick(), "SKIPPED");
}

TEST(Timeout, ZeroMeansNoLimit) {
  Story story(R"(<Timeout msec="0"><A/></Timeout>)");
  story.tick();
  EXPECT_EQ(story.tick(1'000'000), "RUNNING: A");
}

TEST(Delay, StartsTheChildAfterTheDelay) {
  Story story(R"(<Delay delay_msec="1000"><A/></Delay>)");
  EXPECT_EQ(story.tick(), "RUNNING");
  EXPECT_EQ(story.tick(999), "RUNNING");
  EXPECT_EQ(story.tick(1), "RUNNING: start A");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: A");
  EXPECT_EQ(story.tick(), "RUNNING") << "waits anew";
}

TEST(SetBlackboard, WritesTextAndCopies) {
  Story story(R"(<Sequence>
      <SetBlackboard value="2" output_key="n"/>
      <SetBlackboard value="{n}" output_key="{m}"/>
      <Repeat num_cycles="{m}"><A/></Repeat>
    </Sequence>)");
  ASSERT_EQ(toString(story.problems()), "");
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

TEST(SetBlackboard, AnEntryThatIsNotSetYetFailsWithAReason) {
  Story story(R"(<Sequence>
      <Repeat num_cycles="{n}"><A/></Repeat>
      <SetBlackboard value="2" output_key="n"/>
    </Sequence>)");
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.tick(), "FAILURE");
  EXPECT_THAT(story.failures(), ElementsAre("Repeat: port num_cycles: the entry {n} is not set"));
}

constexpr const char* kThrice =
    R"(<BehaviorTree ID="Thrice"><Repeat num_cycles="{times}"><A/></Repeat></BehaviorTree>)";

TEST(SubTree, AcceptsALiteralPort) {
  Story story(R"(<SubTree ID="Thrice" times="1"/>)", kThrice);
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
  EXPECT_EQ(story.view(), "Thrice SUCCESS, Repeat SUCCESS, A SUCCESS");
}

TEST(SubTree, RemapsAnEntryOfTheOuterTree) {
  Story story(R"(<Sequence><SetBlackboard value="1" output_key="n"/><SubTree ID="Thrice" times="{n}"/></Sequence>)",
              kThrice);
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(SubTree, HasItsOwnEntries) {
  Story story(R"(<Sequence><SetBlackboard value="1" output_key="times"/><SubTree ID="Thrice"/></Sequence>)", kThrice);
  EXPECT_THAT(story.problems(), ElementsAre(At("5:35 Repeat.num_cycles", "tree.entry-unset", "{times}",
                                               "times=\"{times}\"", "_autoremap=\"true\"")));
}

TEST(SubTree, RunsItsScriptsOnTheEntriesOfEachUse) {
  Story story(R"(<Sequence><Script code="a := 1; b := 10"/><SubTree ID="Add" x="{a}"/><SubTree ID="Add" x="{b}"/>
                 <A _skipIf="a != 2 || b != 12"/></Sequence>)",
              R"(<BehaviorTree ID="Add"><Script code="x += 1" _onSuccess="x += x > 10 ? 1 : 0"/></BehaviorTree>)");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
}

TEST(SubTree, AutoremapSharesAllNamesExceptPrivateOnes) {
  const char* autoremap =
      R"(<Sequence><SetBlackboard value="1" output_key="times"/><SubTree ID="Thrice" _autoremap="true"/></Sequence>)";
  EXPECT_EQ(Story(autoremap, kThrice).says("A", "SUCCESS").tick(), "SUCCESS: start A");
  Story is_private(
      R"(<Sequence><SetBlackboard value="1" output_key="_n"/><SubTree ID="Private" _autoremap="true"/></Sequence>)",
      R"(<BehaviorTree ID="Private"><Repeat num_cycles="{_n}"><A/></Repeat></BehaviorTree>)");
  EXPECT_EQ(is_private.problems().size(), 1U);
}

TEST(SubTree, AnEqualSignMeansTheSameName) {
  Story story(R"(<Sequence><SetBlackboard value="1" output_key="times"/><SubTree ID="Thrice" times="{=}"/></Sequence>)",
              kThrice);
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(SubTree, AnAtSignMeansAnEntryOfTheMainTree) {
  Story story(R"(<Sequence><SetBlackboard value="1" output_key="n"/><SubTree ID="Deep"/></Sequence>)",
              R"(<BehaviorTree ID="Deep"><Repeat num_cycles="{@n}"><A/></Repeat></BehaviorTree>)");
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(SubTree, UsesTheDefaultOfItsModel) {
  Story story(
      R"(<SubTree ID="Thrice"/>)",
      std::string(kThrice) +
          R"(<TreeNodesModel><SubTree ID="Thrice"><input_port name="times" default="1"/></SubTree></TreeNodesModel>)");
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

constexpr const char* kModel =
    R"(<TreeNodesModel><SubTree ID="Thrice"><input_port name="times" default="7"/></SubTree></TreeNodesModel>)";

TEST(SubTree, WhatAutoremapSharesTakesThePlaceOfADefault) {
  Story story(
      R"(<Sequence><SetBlackboard value="1" output_key="times"/><SubTree ID="Thrice" _autoremap="True"/></Sequence>)",
      std::string(kThrice) + kModel);
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(SubTree, APortOfItsModelWithoutDefaultMustBeGiven) {
  std::string model = kModel;
  model.replace(model.find(R"( default="7")"), 12, "");
  Story story(R"(<Sequence><A/><SubTree ID="Thrice"/></Sequence>)", std::string(kThrice) + model);
  ASSERT_FALSE(story.problems().empty());
  EXPECT_THAT(story.problems()[0],
              At("3:15 SubTree", "tree.subtree-port-missing", "`times`", "[Main/Sequence/Thrice]"));
}

TEST(SubTree, AFlagThatItIsGivenIsATruthValue) {
  const char* photo = R"(<BehaviorTree ID="Visit"><A _skipIf="photo == false"/></BehaviorTree>)";
  EXPECT_EQ(Story(R"(<SubTree ID="Visit" photo="false"/>)", photo).tick(), "SKIPPED");
  EXPECT_EQ(Story(R"(<SubTree ID="Visit" photo="true"/>)", photo).tick(), "RUNNING: start A");
}

TEST(Entries, MayHaveBlanksAroundTheirBraces) {
  Story story(R"(<Sequence><Script code="n := 1"/><Repeat num_cycles=" { n } "><A/></Repeat></Sequence>)");
  ASSERT_EQ(toString(story.problems()), "");
  EXPECT_EQ(story.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(SubTree, TwoUsesOfATreeAreIndependent) {
  Story story(
      R"(<Sequence><SubTree ID="Thrice" times="1" name="first"/><SubTree ID="Thrice" times="2" name="second"/></Sequence>)",
      kThrice);
  story.says("A", "SUCCESS");
  EXPECT_EQ(story.tick(), "RUNNING: start A, start A");
  EXPECT_EQ(story.tick(), "SUCCESS: start A");
}

TEST(Tree, TheHostSetsTheEntriesItDeclared) {
  Stage stage;
  const Registry registry = withStandIns(stage);
  ParseOptions options;
  options.host_entries = {"n"};
  ParseResult parsed = parseText(file(R"(<Repeat num_cycles="{n}"><A/></Repeat>)"), "host.xml", registry, options);
  ASSERT_EQ(toString(parsed.problems), "");
  TickContext context;
  EXPECT_EQ(parsed.tree->tick(context), Status::kFailure) << "not set yet";
  EXPECT_FALSE(parsed.tree->set("m", std::int64_t{0}));
  EXPECT_TRUE(parsed.tree->set("n", std::int64_t{0}));
  EXPECT_EQ(parsed.tree->tick(context), Status::kSuccess);
  EXPECT_TRUE(parsed.tree->set("n", std::int64_t{-7}));
  EXPECT_EQ(parsed.tree->tick(context), Status::kFailure) << "out of range";
}

}  // namespace
}  // namespace swiftlet::tree::testing
