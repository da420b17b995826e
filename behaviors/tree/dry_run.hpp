// Ticks a tree without anything to fly: its leaves answer what a script says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "behaviors/tree/outcome_script.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

struct DryRunTick {
  std::int64_t now_ns = 0;
  Status answer = Status::kIdle;
  /// What happened, in order: "Main/Sequence/Land: RUNNING -> SUCCESS", a switch of a Priority, a failure with its
  /// reason.
  std::vector<std::string> events;
};

struct DryRun {
  /// Leaves that the script does not name, and what they answer: "Land: SUCCESS".
  std::vector<std::string> unscripted;
  std::vector<DryRunTick> ticks;  ///< To the first SUCCESS or FAILURE of the tree, or the limit of the script.
  std::vector<Problem> problems;  ///< Of the file and of the script. With one there are no ticks.
};

/// Leaves of `base` that are not of the engine are stand-ins with the ports of their types; they neither read nor write
/// entries. With `mocks`, types that `base` does not have are mocks (mocks.hpp). A leaf that the script does not name
/// is SKIPPED if it can be, a condition that it does not name is false, any other leaf SUCCESS. The engine's own leaves
/// (Script, Sleep ...) do what they always do.
DryRun dryRun(const std::string& path, const Registry& base, const OutcomeScript& script, bool mocks);

}  // namespace swiftlet::tree
