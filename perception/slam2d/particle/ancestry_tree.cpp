#include "perception/slam2d/particle/ancestry_tree.hpp"

#include <algorithm>

#include "common/check.hpp"

namespace swiftlet::perception {

int AncestryTree::add(int parent, const common::Pose2& pose) {
  if (parent != kNone) ++nodeAt(parent).references;
  if (free_.empty()) {
    nodes_.push_back({pose, parent, 1});
    return static_cast<int>(nodes_.size()) - 1;
  }
  const int index = free_.back();
  free_.pop_back();
  nodeAt(index) = {pose, parent, 1};
  return index;
}

void AncestryTree::release(int leaf) {
  for (int index = leaf; index != kNone;) {
    Node& node = nodeAt(index);
    SWIFTLET_CHECK(node.references > 0, index);
    if (--node.references > 0) return;
    free_.push_back(index);
    index = node.parent;
  }
}

std::vector<common::Pose2> AncestryTree::pathTo(int leaf) const {
  std::vector<common::Pose2> path;
  for (int index = leaf; index != kNone;) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    path.push_back(node.pose);
    index = node.parent;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace swiftlet::perception
