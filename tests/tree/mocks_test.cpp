// Mocks stand in for the nodes of other programs: trees are judged by their statuses, tick by tick, written by hand.
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"
#include "tests/support/datasets.hpp"
#include "tests/tree/mocked_tree.hpp"
#include "tests/tree/problem_matcher.hpp"

namespace swiftlet::tree {
namespace {

using testing::At;
using ::testing::ElementsAre;
using testing::MockedTree;

std::vector<std::string> namesOf(const std::vector<Mock>& mocks) {
  std::vector<std::string> names;
  for (const Mock& mock : mocks) names.push_back(mock.id + " " + toString(mock.kind));
  return names;
}

std::string written(const std::string& name, const std::string& text) {
  std::string path = (std::filesystem::path(::testing::TempDir()) / name).string();
  std::ofstream(path) << text;
  return path;
}

TEST(Mocks, HaveThePortsAndKindsThatTheFileGives) {
  MockedTree tree(written("mocks_kinds.xml", R"(<root BTCPP_format="4" main_tree_to_execute="M">
    <BehaviorTree ID="M"><Pipeline><Rate hz="1"><Plan path="{p}" _skipIf="false"/></Rate><Condition ID="Near"/>
      <Follow path="{p}"/><Inverter><Check/></Inverter></Pipeline></BehaviorTree>
    <TreeNodesModel><Condition ID="Check"><input_port name="limit"/></Condition><Action ID="Unused"/></TreeNodesModel>
  </root>)"));
  EXPECT_THAT(namesOf(tree.mocks()), ElementsAre("Check Condition", "Follow Action", "Near Condition",
                                                 "Pipeline Control", "Plan Action", "Rate Decorator"));
  tree.says("Follow", Status::kRunning).says("Check", Status::kFailure);
  EXPECT_EQ(tree.tick(),
            "RUNNING: Pipeline RUNNING, Rate SUCCESS, Plan SUCCESS, Near SUCCESS, Follow RUNNING, Inverter IDLE, "
            "Check IDLE");
  tree.says("Follow", Status::kSuccess);
  EXPECT_EQ(tree.tick(),
            "SUCCESS: Pipeline SUCCESS, Rate SUCCESS, Plan SUCCESS, Near SUCCESS, Follow SUCCESS, Inverter SUCCESS, "
            "Check FAILURE");
}

TEST(Mocks, MistakesInTheEnginesNodesStayMistakes) {
  const MockedTree tree(written("mocks_mistake.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="M">
    <Sequence><Repeat num_cycle="2"><Do/></Repeat><M/></Sequence></BehaviorTree></root>)"));
  EXPECT_THAT(tree.problems(), ElementsAre(At("2:23 Repeat", "tree.unknown-port", "`num_cycle`"),
                                           At("2:15 Repeat", "tree.port-missing", "`num_cycles`"),
                                           At("2:51 M", "tree.unknown-node", "<SubTree ID=\"M\"/>")));
}

TEST(Mocks, StandInForATypeOfTheSameNameWithOtherPorts) {
  Registry base = Registry::standard();
  const auto build = base.find("AlwaysSuccess")->build;
  base.add({.id = "TakeOff", .kind = NodeKind::kAction, .ports = {{.name = "height_m"}}, .description = "Ours."},
           build);
  base.add({.id = "Land", .kind = NodeKind::kAction, .ports = {}, .description = "Ours."}, build);
  MockedTree tree(written("mocks_same_name.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="M">
    <Sequence><TakeOff height="2" speed="0.5"/><Land/></Sequence></BehaviorTree></root>)"),
                  base);
  ASSERT_THAT(namesOf(tree.mocks()), ElementsAre("TakeOff Action"));
  EXPECT_EQ(tree.mocks()[0].instead_of_port, "speed");
  tree.says("TakeOff", Status::kFailure);
  EXPECT_EQ(tree.tick(), "FAILURE: Sequence FAILURE, TakeOff FAILURE, Land IDLE");
}

TEST(Mocks, WithThousandsOfPortsAreRefusedInAMoment) {
  std::string ports;
  for (int i = 0; i < 50'000; ++i) ports += " a" + std::to_string(i) + "=\"1\"";
  const std::clock_t start = std::clock();
  const MockedTree tree(written(
      "mocks_ports.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Do" + ports + "/></BehaviorTree></root>"));
  EXPECT_EQ(tree.problems().size(), 101U);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
}

TEST(Mocks, OfNav2WatchTheBounds) {
  const auto folder = test_support::dataSet("08-behavior-trees");
  if (!folder) return;
  MockedTree tree((*folder / "nav2/navigate_to_pose_w_bounds_check.xml").string());
  tree.says("ComputePathToPose", Status::kRunning);
  EXPECT_EQ(tree.tick(),
            "RUNNING: Sequence RUNNING, ComputePathToPose RUNNING, ReactiveSequence IDLE, IsWithinPathTrackingBounds "
            "IDLE, FollowPath IDLE");
  tree.says("ComputePathToPose", Status::kSuccess).says("FollowPath", Status::kRunning);
  EXPECT_EQ(tree.tick(),
            "RUNNING: Sequence RUNNING, ComputePathToPose SUCCESS, ReactiveSequence RUNNING, "
            "IsWithinPathTrackingBounds SUCCESS, FollowPath RUNNING");
  tree.says("IsWithinPathTrackingBounds", Status::kFailure);
  EXPECT_EQ(tree.tick(),
            "FAILURE: Sequence FAILURE, ComputePathToPose SUCCESS, ReactiveSequence FAILURE, "
            "IsWithinPathTrackingBounds FAILURE, FollowPath IDLE");
}

TEST(Mocks, LetEveryNav2TreeBeReadAndTicked) {
  const auto folder = test_support::dataSet("08-behavior-trees");
  if (!folder) return;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder / "nav2")) {
    MockedTree tree(entry.path().string());
    EXPECT_TRUE(tree.problems().empty()) << toString(tree.problems());
    const std::string told = tree.tick();
    EXPECT_TRUE(told.starts_with("SUCCESS") || told.starts_with("RUNNING")) << entry.path() << told;
    ++count;
  }
  EXPECT_EQ(count, 10);
}

}  // namespace
}  // namespace swiftlet::tree
