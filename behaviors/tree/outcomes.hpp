// How the nodes of a tree may end, judged from the file alone, and the children that are therefore never ticked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/tree.hpp"

namespace swiftlet::tree {

/// The statuses that a node may end with; all false: it runs forever.
struct Outcomes {
  bool success = false;
  bool failure = false;
  /// It may answer SKIPPED when it is asked. A Delay is active first: where its child may be SKIPPED, it may succeed
  /// and fail instead.
  bool skipped = false;

  bool operator==(const Outcomes&) const = default;
};

/// How a node asks its children one after the other.
enum class ChainRule : unsigned char { kNone, kSequence, kFallback };
ChainRule chainOf(const NodeRecord& record);

/// What an application knows of a leaf beyond its manifest; nullopt where the manifest is complete.
using LeafOutcomes = std::function<std::optional<Outcomes>(const NodeRecord& leaf)>;

/// Whether every value that the port may have before the first tick is that number.
bool isAlways(const Tree& tree, const NodeRecord& record, std::string_view port, std::int64_t number);

/// By node id.
std::vector<Outcomes> outcomesOf(const Tree& tree, const LeafOutcomes& leaf_outcomes = {});

/// A node that is never ticked.
struct Unreached {
  int node = -1;
  std::string why;  ///< "`AlwaysSuccess` before it never fails".
};

/// The topmost nodes that are never ticked, in preorder; those below them are not listed.
std::vector<Unreached> unreachedNodes(const Tree& tree, const std::vector<Outcomes>& outcomes);

}  // namespace swiftlet::tree
