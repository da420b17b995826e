// The trajectories of a particle filter: a tree in which each particle holds a leaf and shares the path to it with
// related particles. Poses that no particle descends from are freed, so that memory grows with the length of the
// trajectories, not with the number of particles.
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// A tree of poses with reference counts. Not thread-safe.
class AncestryTree {
 public:
  static constexpr int kNone = -1;

  /// Adds a leaf at a pose, held once, and returns its index. Its parent (kNone for a root) stays as long as it does.
  int add(int parent, const common::Pose2& pose);
  /// Adds a hold on a leaf.
  void hold(int leaf) { ++nodeAt(leaf).references; }
  /// Removes a hold from a leaf. The last hold removes the leaf, and all ancestors that have no other hold or
  /// descendant.
  void release(int leaf);

  /// The poses from the root to the leaf.
  std::vector<common::Pose2> pathTo(int leaf) const;
  /// Number of stored poses.
  std::size_t size() const { return nodes_.size() - free_.size(); }

 private:
  struct Node {
    common::Pose2 pose;
    int parent = kNone;
    int references = 0;  ///< Number of holds and children.
  };
  Node& nodeAt(int index) { return nodes_[static_cast<std::size_t>(index)]; }

  std::vector<Node> nodes_;
  std::vector<int> free_;
};

}  // namespace swiftlet::perception
