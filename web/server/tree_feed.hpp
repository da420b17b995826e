// The tree of the mission for many pages: each page gets the nodes that have changed since its last message.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/world/tree_view.hpp"

namespace swiftlet::web {

class TreeFeed {
 public:
  /// Compares with the last tree. A tree of other nodes is another mission: every page gets it as a whole.
  void update(const common::TreeView& tree);

  /// Rises when anything changed.
  std::uint64_t version() const { return version_; }
  /// What a page that has `version` lacks, as JSON: {"type": "tree", "whole": true, "nodes": [...]}. Of a page that has
  /// the nodes of this tree only what may change is sent: id, status, ports, reason, began_s, duration_s. Empty if it
  /// has everything.
  std::string since(std::uint64_t version) const;

 private:
  common::TreeView tree_;
  std::vector<std::uint64_t> changed_;  ///< By node: the version in which it changed last.
  std::uint64_t version_ = 0;
  std::uint64_t whole_ = 0;  ///< The version in which the tree was replaced.
};

}  // namespace swiftlet::web
