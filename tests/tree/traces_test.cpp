// Trees of other projects, tick by tick: what every node must be after each tick, by the rules of BehaviorTree.CPP 4.
// Leaves that only those projects have are mocks that answer what the test says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/datasets.hpp"
#include "tests/tree/mocked_tree.hpp"

namespace swiftlet::tree::testing {
namespace {

/// Null without the data set.
std::unique_ptr<MockedTree> treeOf(const char* file) {
  const auto folder = test_support::dataSet("08-behavior-trees");
  if (!folder) return nullptr;
  auto tree = std::make_unique<MockedTree>((*folder / file).string());
  EXPECT_TRUE(tree->problems().empty()) << toString(tree->problems());
  return tree;
}

TEST(Traces, OfGrootsDoor) {
  const auto tree = treeOf("groot/crossdoor_with_subtree.xml");
  if (!tree) return;
  tree->says("IsDoorOpen", Status::kFailure).says("OpenDoor", Status::kFailure);
  // An attempt that begins and ends in a tick ends that tick; four are allowed.
  for (int attempt = 1; attempt <= 3; ++attempt)
    EXPECT_EQ(tree->tick(),
              "RUNNING: root_Fallback RUNNING, door_open_sequence FAILURE, IsDoorOpen FAILURE, PassThroughDoor IDLE, "
              "DoorClosed RUNNING, door_closed_sequence RUNNING, Inverter SUCCESS, IsDoorOpen FAILURE, "
              "RetryUntilSuccessful RUNNING, OpenDoor FAILURE, PassThroughDoor IDLE, CloseDoor IDLE, PassThroughWindow "
              "IDLE");
  EXPECT_EQ(tree->tick(),
            "SUCCESS: root_Fallback SUCCESS, door_open_sequence FAILURE, IsDoorOpen FAILURE, PassThroughDoor IDLE, "
            "DoorClosed FAILURE, door_closed_sequence FAILURE, Inverter SUCCESS, IsDoorOpen FAILURE, "
            "RetryUntilSuccessful FAILURE, OpenDoor FAILURE, PassThroughDoor IDLE, CloseDoor IDLE, PassThroughWindow "
            "SUCCESS");
  // The door is open: it starts anew, and nothing but the first sequence is asked.
  tree->says("IsDoorOpen", Status::kSuccess).says("PassThroughDoor", Status::kRunning);
  EXPECT_EQ(tree->tick(),
            "RUNNING: root_Fallback RUNNING, door_open_sequence RUNNING, IsDoorOpen SUCCESS, PassThroughDoor RUNNING, "
            "DoorClosed IDLE, door_closed_sequence IDLE, Inverter IDLE, IsDoorOpen IDLE, RetryUntilSuccessful IDLE, "
            "OpenDoor IDLE, PassThroughDoor IDLE, CloseDoor IDLE, PassThroughWindow IDLE");
}

TEST(Traces, OfGrootsRetry) {
  const auto tree = treeOf("groot/Simple.xml");
  if (!tree) return;
  tree->says("OpenDoor", Status::kFailure);
  EXPECT_EQ(tree->tick(), "RUNNING: door_closed_sequence RUNNING, RetryUntilSuccessful RUNNING, OpenDoor FAILURE");
  tree->says("OpenDoor", Status::kRunning);
  EXPECT_EQ(tree->tick(), "RUNNING: door_closed_sequence RUNNING, RetryUntilSuccessful RUNNING, OpenDoor RUNNING");
  // The second attempt took longer than a tick, so that the third begins in the tick in which it fails.
  tree->says("OpenDoor", Status::kFailure);
  EXPECT_EQ(tree->tick(), "RUNNING: door_closed_sequence RUNNING, RetryUntilSuccessful RUNNING, OpenDoor FAILURE");
  tree->says("OpenDoor", Status::kSuccess);
  EXPECT_EQ(tree->tick(), "SUCCESS: door_closed_sequence SUCCESS, RetryUntilSuccessful SUCCESS, OpenDoor SUCCESS");
}

TEST(Traces, OfASequenceWithMemory) {
  const auto tree = treeOf("btcpp/examples/test_files/Check.xml");
  if (!tree) return;
  tree->says("CheckTemperature", Status::kFailure);
  EXPECT_EQ(tree->tick(), "RUNNING: SequenceWithMemory RUNNING, CheckBattery SUCCESS, CheckTemperature IDLE");
  EXPECT_EQ(tree->tick(), "FAILURE: SequenceWithMemory FAILURE, CheckBattery SUCCESS, CheckTemperature FAILURE");
  tree->says("CheckTemperature", Status::kSuccess);
  EXPECT_EQ(tree->tick(), "SUCCESS: SequenceWithMemory SUCCESS, CheckBattery IDLE, CheckTemperature SUCCESS")
      << "the battery is not asked again";
  EXPECT_EQ(tree->tick(), "RUNNING: SequenceWithMemory RUNNING, CheckBattery SUCCESS, CheckTemperature IDLE");
}

TEST(Traces, OfFilesThatIncludeEachOther) {
  const auto tree = treeOf("btcpp/tests/trees/parent_include_child_include_sibling.xml");
  if (!tree) return;
  EXPECT_EQ(tree->tick(),
            "SUCCESS: Sequence SUCCESS, ChildIncludeSibling SUCCESS, Sequence SUCCESS, ChildNoInclude SUCCESS, "
            "AlwaysSuccess SUCCESS, AlwaysSuccess SUCCESS, AlwaysSuccess SUCCESS");
}

TEST(Traces, OfNav2PlanAgainOnlyWhenThePathIsInvalid) {
  const auto tree = treeOf("nav2/navigate_w_replanning_only_if_path_becomes_invalid.xml");
  if (!tree) return;
  const std::string head = "NavigateWithReplanning RUNNING, ControllerSelector SUCCESS, PlannerSelector SUCCESS, ";
  tree->says("ComputePathToPose", Status::kRunning).says("FollowPath", Status::kRunning);
  EXPECT_EQ(tree->tick(),
            "RUNNING: " + head +
                "RateController RUNNING, Fallback RUNNING, ReactiveSequence FAILURE, Inverter FAILURE, "
                "GlobalUpdatedGoal SUCCESS, ValidatePath IDLE, ComputePathToPose RUNNING, FollowPath IDLE");
  tree->says("ComputePathToPose", Status::kSuccess).says("GlobalUpdatedGoal", Status::kFailure);
  EXPECT_EQ(tree->tick(), "RUNNING: " + head +
                              "RateController SUCCESS, Fallback SUCCESS, ReactiveSequence FAILURE, Inverter FAILURE, "
                              "GlobalUpdatedGoal SUCCESS, ValidatePath IDLE, ComputePathToPose SUCCESS, FollowPath "
                              "RUNNING")
      << "a Fallback does not ask again what has failed";
  tree->says("FollowPath", Status::kFailure);
  EXPECT_THAT(tree->tick(), ::testing::StartsWith("FAILURE: NavigateWithReplanning FAILURE"));
  tree->says("FollowPath", Status::kRunning);
  EXPECT_EQ(tree->tick(), "RUNNING: " + head +
                              "RateController SUCCESS, Fallback SUCCESS, ReactiveSequence SUCCESS, Inverter SUCCESS, "
                              "GlobalUpdatedGoal FAILURE, ValidatePath SUCCESS, ComputePathToPose IDLE, FollowPath "
                              "RUNNING");
}

TEST(Traces, OfNav2FollowAPointUntilThatFails) {
  const auto tree = treeOf("nav2/follow_point.xml");
  if (!tree) return;
  const std::string planned =
      "ControllerSelector SUCCESS, PlannerSelector SUCCESS, RateController SUCCESS, Sequence SUCCESS, GoalUpdater "
      "SUCCESS, ComputePathToPose SUCCESS, TruncatePath SUCCESS, ";
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(tree->tick(), "RUNNING: NavigateWithReplanning RUNNING, " + planned +
                                "KeepRunningUntilFailure RUNNING, FollowPath SUCCESS");
  tree->says("FollowPath", Status::kRunning);
  EXPECT_EQ(tree->tick(), "RUNNING: NavigateWithReplanning RUNNING, " + planned +
                              "KeepRunningUntilFailure RUNNING, FollowPath RUNNING");
  tree->says("FollowPath", Status::kFailure);
  EXPECT_EQ(tree->tick(), "FAILURE: NavigateWithReplanning FAILURE, " + planned +
                              "KeepRunningUntilFailure FAILURE, FollowPath FAILURE");
}

}  // namespace
}  // namespace swiftlet::tree::testing
