// The tree of the mission for the pages: everything once, then only what changed.
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "web/server/tree_feed.hpp"

namespace swiftlet::web {
namespace {

common::TreeView treeOf(int nodes) {
  common::TreeView tree;
  for (int i = 0; i < nodes; ++i)
    tree.push_back({i, (i - 1) / 3 - (i == 0 ? 1 : 0), "node " + std::to_string(i), "IDLE", "Sequence"});
  return tree;
}

/// What a page has after the messages.
struct TreePage {
  std::map<int, nlohmann::json> nodes;
  std::uint64_t version = 0;

  /// How many nodes it was told.
  std::size_t read(const TreeFeed& feed) {
    const std::string text = feed.since(version);
    version = feed.version();
    if (text.empty()) return 0;
    const auto message = nlohmann::json::parse(text);
    if (message["whole"]) nodes.clear();
    for (const auto& node : message["nodes"]) nodes[node["id"]].update(node);
    return message["nodes"].size();
  }
};

TEST(TreeFeedTest, TellsEverythingOnceAndThenTheChanges) {
  TreeFeed feed;
  common::TreeView tree = treeOf(500);
  feed.update(tree);
  TreePage page;
  EXPECT_EQ(page.read(feed), 500U);
  EXPECT_EQ(page.nodes[7]["name"], "node 7");
  EXPECT_EQ(page.nodes[7]["parent"], 2);
  EXPECT_EQ(page.read(feed), 0U);
  feed.update(tree);
  EXPECT_EQ(page.read(feed), 0U) << "nothing changed";
  tree[7].status = "FAILURE";
  tree[7].reason = "no path";
  tree[7].ports = {{"goal", "door", "1;2"}, {"mode", "", "fast"}, {"yaw_deg", "look", std::nullopt}};
  tree[7].began_s = 1.25;
  feed.update(tree);
  EXPECT_LT(feed.since(page.version).size(), 300U);
  EXPECT_EQ(page.read(feed), 1U);
  EXPECT_EQ(page.nodes[7]["name"], "node 7");
  EXPECT_EQ(page.nodes[7]["status"], "FAILURE");
  EXPECT_EQ(page.nodes[7]["reason"], "no path");
  EXPECT_EQ(page.nodes[7]["ports"],
            nlohmann::json({{"goal", "{door} = 1;2"}, {"mode", "fast"}, {"yaw_deg", "{look}"}}));
  EXPECT_EQ(page.nodes[7]["began_s"], 1.25);
  EXPECT_TRUE(page.nodes[7]["duration_s"].is_null());
}

TEST(TreeFeedTest, PagesThatReadAtAnyTimeHaveTheSame) {
  std::mt19937 random(3);
  TreeFeed feed;
  common::TreeView tree = treeOf(40);
  TreePage often, seldom;
  for (int i = 0; i < 200; ++i) {
    if (i == 120) tree = treeOf(25);  // Another mission.
    tree[random() % tree.size()].status = i % 3 == 0 ? "RUNNING" : "SUCCESS";
    feed.update(tree);
    often.read(feed);
    if (i % 37 == 0) seldom.read(feed);
  }
  seldom.read(feed);
  EXPECT_EQ(often.nodes, seldom.nodes);
  EXPECT_EQ(often.nodes.size(), 25U);
  for (const common::TreeNodeView& node : tree) EXPECT_EQ(often.nodes[node.id]["status"], node.status);
}

}  // namespace
}  // namespace swiftlet::web
