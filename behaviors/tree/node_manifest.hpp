// Description of a node type: its name, kind and ports.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"

namespace swiftlet::tree {

enum class NodeKind : unsigned char { kAction, kCondition, kControl, kDecorator };
/// "Action", "Condition", "Control", "Decorator": the tags of the explicit form.
const char* toString(NodeKind kind);

struct NodeManifest {
  std::string id = {};
  NodeKind kind = NodeKind::kAction;
  std::vector<PortManifest> ports = {};
  std::string description = {};  ///< One sentence.
  /// Whether it may answer SKIPPED on its own (leaves), or only if its children do.
  bool may_skip = false;

  const PortManifest* findPort(std::string_view name) const;
  /// Controls: 1 or more; decorators: 1; leaves: 0.
  int minChildren() const { return kind == NodeKind::kControl || kind == NodeKind::kDecorator ? 1 : 0; }
  int maxChildren() const {
    return kind == NodeKind::kControl ? std::numeric_limits<int>::max() : kind == NodeKind::kDecorator ? 1 : 0;
  }
};

}  // namespace swiftlet::tree
