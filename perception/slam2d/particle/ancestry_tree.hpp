// The trajectories of a particle filter: a tree in which each particle holds a leaf and shares the way to it with its
// relatives. What no particle descends from any more is forgotten, so that memory grows with the poses on
// the way, not with the number of particles.
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry.hpp"

namespace swiftlet::perception {

class AncestryTree {
 public:
  static constexpr int kNone = -1;

  /// A new leaf at a pose, held once; its parent (kNone: it is a root) stays as long as it does.
  int add(int parent, const common::Pose2& pose);
  /// Holds a leaf once more.
  void hold(int leaf) { ++nodeAt(leaf).references; }
  /// Holds it once less; with the last hold the leaf goes, and with it all ancestors that have no other descendant.
  void release(int leaf);

  /// The poses from the root to the leaf.
  std::vector<common::Pose2> pathTo(int leaf) const;
  /// Poses that are kept.
  std::size_t size() const { return nodes_.size() - free_.size(); }

 private:
  struct Node {
    common::Pose2 pose;
    int parent = kNone;
    int references = 0;  ///< Holds and children.
  };
  Node& nodeAt(int index) { return nodes_[static_cast<std::size_t>(index)]; }

  std::vector<Node> nodes_;
  std::vector<int> free_;
};

}  // namespace swiftlet::perception
