// Options for reading tree files: limits, and the source of their text.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// Limits beyond which a file is refused, so that no input can exhaust stack or memory.
struct ParseLimits {
  std::size_t file_bytes = std::size_t{8} << 20;
  int files = 64;       ///< The file itself and all it includes.
  int depth = 200;      ///< Elements within elements, and nodes within nodes after subtrees are expanded.
  int nodes = 100'000;  ///< After subtrees are expanded.
  int problems = 100;   ///< Further problems are counted, not listed.
};

/// Files that belong together though they do not include each other.
struct TreeFiles {
  std::map<std::string, std::vector<std::string>, std::less<>> trees;  ///< By ID: the files that define it.
  /// Those whose main tree a SubTree of another one uses; of a file that names no main tree: any of its trees.
  std::set<std::string, std::less<>> helpers;
  std::vector<Problem> warnings;  ///< Of a tree that is used and that several of them define.
};

/// The text of a file, or nothing if it cannot be read.
using FileReader = std::function<std::optional<std::string>(const std::string& path)>;

struct ParseOptions {
  ParseLimits limits;
  /// Blackboard entries of the main tree that the host sets before the first tick.
  std::vector<std::string> host_entries;
  FileReader read_file;  ///< Null: the file system.
  /// For files of other programs: what only BehaviorTree.CPP takes, or never looks at, is a warning.
  bool lenient = false;
  /// The program that ticks the tree may set entries that the file does not set: a warning.
  bool host_sets_entries = false;
  /// The tree is a helper of others, whose SubTrees give it its entries: entries that are not set are not reported.
  bool user_sets_entries = false;
  /// Of the files that are given together with this one. Leniently its SubTrees find their trees there, as in a program
  /// that registers all of them; else the hint says which <include> is missing.
  TreeFiles trees_elsewhere;
};

}  // namespace swiftlet::tree
