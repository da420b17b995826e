// A node of a built tree with its facts.
#pragma once

#include <string_view>

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

/// The facts of a node that do not change with its state.
struct NodeRecord {
  Node* node = nullptr;
  int parent = -1;
  const NodeManifest* manifest = nullptr;  ///< Null for a SubTree node.
};

/// The ID of its type; "SubTree" for a SubTree node.
inline std::string_view typeNameOf(const NodeRecord& record) {
  return record.manifest == nullptr ? std::string_view("SubTree") : std::string_view(record.manifest->id);
}

}  // namespace swiftlet::tree
