// A node of a built tree, with what is known of it beside its state.
#pragma once

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

/// What is known of a node beside its state.
struct NodeRecord {
  Node* node = nullptr;
  int parent = -1;
  const NodeManifest* manifest = nullptr;  ///< Null for a SubTree node.
};

}  // namespace swiftlet::tree
