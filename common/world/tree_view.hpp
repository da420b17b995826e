// The tree of a mission as it is shown while it runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace swiftlet::common {

/// A port of a node with its present value.
struct TreePortView {
  std::string name;
  std::string entry;                 ///< The blackboard entry that it is bound to; empty for a literal or a script.
  std::optional<std::string> value;  ///< The literal, the text of the script, or the entry's value, if that is set.

  bool operator==(const TreePortView&) const = default;
};

struct TreeNodeView {
  int id = 0;
  int parent = -1;  ///< -1 for the root.
  std::string name;
  std::string status;                     ///< IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED, SUSPENDED.
  std::string type = {};                  ///< "Sequence", "MoveToGoal", "SubTree" ...
  std::vector<TreePortView> ports = {};   ///< Ports that are bound.
  std::string reason = {};                ///< Why it failed, or why it is active; the last one reported.
  std::optional<double> began_s = {};     ///< When its present or last run began, in the time of the snapshots.
  std::optional<double> duration_s = {};  ///< Of its last run; nullopt while it is under way, or before it.

  bool operator==(const TreeNodeView&) const = default;
};
/// In preorder; the id of a node is its index.
using TreeView = std::vector<TreeNodeView>;

}  // namespace swiftlet::common
