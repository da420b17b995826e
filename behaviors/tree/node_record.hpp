// A node of a built tree with its facts.
#pragma once

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

/// The facts of a node that do not change with its state.
struct NodeRecord {
  Node* node = nullptr;
  int parent = -1;
  const NodeManifest* manifest = nullptr;  ///< Null for a SubTree node.
};

}  // namespace swiftlet::tree
