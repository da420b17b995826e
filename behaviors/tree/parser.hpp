// Reads tree files: XML as BehaviorTree.CPP writes it with BTCPP_format="4", so that Groot2 edits them.
//
// Read: <root main_tree_to_execute>, <BehaviorTree ID>, <include path>, <SubTree ID> with ports and _autoremap,
// <TreeNodesModel> (checked; defaults of SubTree ports are used), nodes in compact form (<TakeOff height_m="1"/>) and
// explicit form (<Action ID="TakeOff" height_m="1"/>), the attributes name, _description, _uid and _fullpath, scripted
// conditions (_skipIf ...).
// Refused with a message that says so: format 3 (migrate.hpp rewrites it), DOCTYPE, ros_pkg. Without BTCPP_format a
// file is read as version 4, with a warning, if nothing in it is of version 3.
//
// All problems of all files are collected, each with line and column; a tree is returned only if there is none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::tree {

struct ParseResult {
  std::optional<Tree> tree;       ///< Present if `problems` is empty.
  std::vector<Problem> problems;  ///< In the order of the files and lines.
  std::vector<Problem> warnings;  ///< What can be read, but should be written otherwise.
};

ParseResult parseFile(const std::string& path, const Registry& registry, const ParseOptions& options = {});
/// Messages use `name` as the file; includes are found relative to its folder.
ParseResult parseText(std::string text, const std::string& name, const Registry& registry,
                      const ParseOptions& options = {});

}  // namespace swiftlet::tree
