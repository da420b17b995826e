// Leaves that throw: the tree treats them as leaves that fail, and says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

TEST(ALeafThatThrows, FailsWithTheReason) {
  Story story("<Fallback><Sequence><A/><B/></Sequence><C/></Fallback>");
  EXPECT_EQ(story.tick(), "RUNNING: start A");
  story.says("A", "throws ticked");
  EXPECT_EQ(story.tick(), "RUNNING: A, start C");
  EXPECT_THAT(story.failures(), ElementsAre("A: threw an exception: boom"));
  EXPECT_EQ(story.view(), "Fallback RUNNING, Sequence FAILURE, A FAILURE, B IDLE, C RUNNING");
  Story other("<A/>");
  other.says("A", "throws a number ticked");
  EXPECT_EQ(other.tick(), "FAILURE: start A");
  EXPECT_THAT(other.failures(), ElementsAre("A: threw what is no exception"));
}

TEST(ALeafThatThrows, WhenItIsAskedFailsInItsTick) {
  Story story("<Priority><A/><B/></Priority>");
  story.says("A", "throws asked");
  EXPECT_EQ(story.tick(), "FAILURE");
  EXPECT_THAT(story.failures(), ElementsAre("A: threw an exception: boom"));
}

TEST(ALeafThatThrows, WhenItLetsGoHasLetGo) {
  Story timeout("<Timeout msec=\"1000\"><A/></Timeout>");
  timeout.says("A", "stops in 5").says("A", "throws letting go");
  EXPECT_EQ(timeout.tick(), "RUNNING: start A");
  EXPECT_EQ(timeout.tick(1000), "FAILURE");
  EXPECT_THAT(timeout.failures(), ElementsAre("Timeout: timed out after 1 s", "A: threw an exception: boom"));
  Story priority("<Priority><A/><B/></Priority>");
  priority.says("A", "nothing").says("B", "throws letting go");
  EXPECT_EQ(priority.tick(), "RUNNING: start B");
  priority.says("A", "RUNNING").says("A", "throws explaining");
  EXPECT_EQ(priority.tick(), "RUNNING: start A");
  EXPECT_THAT(priority.switches(),
              ElementsAre("B takes over from nobody (B wants)", "B yields to A (threw an exception: boom)",
                          "A takes over from B (threw an exception: boom)"));
}

}  // namespace
}  // namespace swiftlet::tree::testing
