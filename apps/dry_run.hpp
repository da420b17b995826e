// The dry run of swiftlet check: a mission ticked with scripted answers of its leaves.
#pragma once

#include <string>

#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::apps {

struct DryRunOptions {
  std::string mission;  ///< A file that was found sound.
  std::string script;
  bool mock_leaves = false;
  bool json = false;
  tree::ParseOptions parsing = {};
};

/// Prints each tick as it happens; as JSON all of them at the end. Returns the exit code: kFailed if the mission ends
/// with FAILURE, or is still RUNNING after the last tick. Throws common::InputError for a script that cannot be used.
int showDryRun(const DryRunOptions& options, const tree::Registry& types);

}  // namespace swiftlet::apps
