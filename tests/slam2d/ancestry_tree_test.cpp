// The set of particles of ParticleSlam: trajectories that share their past.
#include "perception/slam2d/particle/ancestry_tree.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

TEST(AncestryTree, ParticlesOfOneAncestorShareTheirPast) {
  AncestryTree tree;
  const int root = tree.add(AncestryTree::kNone, {0.0, 0.0, 0.0});
  const int parent = tree.add(root, {1.0, 0.0, 0.0});
  tree.release(root);
  const int a = tree.add(parent, {2.0, 0.1, 0.0}), b = tree.add(parent, {2.0, -0.1, 0.0});
  tree.release(parent);
  EXPECT_EQ(tree.size(), 4U);
  ASSERT_EQ(tree.pathTo(a).size(), 3U);
  EXPECT_EQ(tree.pathTo(a).front().x_m, 0.0);
  EXPECT_EQ(tree.pathTo(a)[1].x_m, 1.0);
  EXPECT_EQ(tree.pathTo(a).back().y_m, 0.1);
  EXPECT_EQ(tree.pathTo(b).back().y_m, -0.1);
}

TEST(AncestryTree, ForgetsPosesWithoutDescendants) {
  AncestryTree tree;
  const int root = tree.add(AncestryTree::kNone, {});
  std::vector<int> leaves{root, root};
  tree.hold(root);
  // Two lines side by side, of which one dies out.
  for (int i = 0; i < 1000; ++i) {
    for (int& leaf : leaves) {
      const int next = tree.add(leaf, {static_cast<double>(i), 0.0, 0.0});
      tree.release(leaf);
      leaf = next;
    }
  }
  EXPECT_EQ(tree.size(), 2001U);
  tree.release(leaves[0]);
  EXPECT_EQ(tree.size(), 1001U);
  EXPECT_EQ(tree.pathTo(leaves[1]).size(), 1001U);
  // The memory of the extinct line is reused.
  const int other = tree.add(leaves[1], {});
  tree.release(leaves[1]);
  EXPECT_EQ(tree.pathTo(other).size(), 1002U);
  tree.release(other);
  EXPECT_EQ(tree.size(), 0U);
}

}  // namespace
}  // namespace swiftlet::perception
