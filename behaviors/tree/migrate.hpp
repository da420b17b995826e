// Rewrites a tree file of BehaviorTree.CPP 3 as one of version 4. Comments, blanks and everything that both versions
// share stay as they are.
#pragma once

#include <string>
#include <vector>

#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

struct Migration {
  std::string text;              ///< The file in version 4; empty if there are problems.
  std::vector<Problem> changes;  ///< What was rewritten, with its place in the old file. Empty for a file of version 4.
  std::vector<Problem> problems;  ///< Why the file cannot be rewritten.
};

/// Messages use `name` as the file. Files that it includes are not read; each of them is migrated by itself. Nodes that
/// this engine does not have stay, for the checker to report.
Migration migrateToVersion4(std::string text, const std::string& name);

}  // namespace swiftlet::tree
