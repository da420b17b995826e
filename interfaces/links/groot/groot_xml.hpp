// A running tree as the XML that Groot2 shows: each use of a subtree is a tree of its own, each node has a _uid.
#pragma once

#include <string>
#include <vector>

#include "common/world/tree_view.hpp"

namespace swiftlet::interfaces {

/// `name` is the ID of the main tree, as BehaviorTree.CPP shows it; "Main" if it is empty. The _uid of a node is its
/// id + 1.
std::string grootXml(const std::string& name, const common::TreeView& tree, const std::string& models);

/// By node: the name of the blackboard that its entries belong to: the ID of the main tree, or "Visit::7" and
/// "Visit::7/Look::9" in subtrees, which is the _fullpath of that tree in the XML.
std::vector<std::string> grootBlackboards(const std::string& name, const common::TreeView& tree);

}  // namespace swiftlet::interfaces
