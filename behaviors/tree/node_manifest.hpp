// Description of a node type: its name, kind and ports.
#pragma once

#include <any>
#include <limits>
#include <optional>
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
  std::string details = {};      ///< What more its user should know, for documents; may be empty.
  std::string ends = {};         ///< "SUCCESS when it hovers there", for documents; may be empty.
  /// Whether it may answer SKIPPED on its own (leaves), or only if its children do.
  bool may_skip = false;
  /// Of nodes with children that need a number of them; others take what their kind does.
  std::optional<int> least_children = std::nullopt, most_children = std::nullopt;
  std::string about_children = {};  ///< What they are for, for messages; may be empty.
  /// Leaves: whether it may end with SUCCESS, and with FAILURE for any other reason than a port that has no value.
  bool may_succeed = true;
  bool may_fail = true;
  /// What the checks of an application need to know of its own leaf; the engine does not read it.
  std::any traits = {};

  const PortManifest* findPort(std::string_view name) const;
  /// Controls: 1 or more; decorators: 1; leaves: 0.
  int minChildren() const {
    return least_children.value_or(kind == NodeKind::kControl || kind == NodeKind::kDecorator ? 1 : 0);
  }
  int maxChildren() const {
    if (most_children) return *most_children;
    return kind == NodeKind::kControl ? std::numeric_limits<int>::max() : kind == NodeKind::kDecorator ? 1 : 0;
  }
};

}  // namespace swiftlet::tree
