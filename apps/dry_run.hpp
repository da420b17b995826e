// The dry run of swiftlet check: a mission ticked with scripted answers of its leaves.
#pragma once

#include <string>

namespace swiftlet::apps {

struct DryRunOptions {
  std::string mission;  ///< A file that was found sound.
  std::string script;
  bool mock_leaves = false;
  bool json = false;
};

/// Prints what happens, tick by tick. Throws common::InputError for a script that cannot be used.
void showDryRun(const DryRunOptions& options);

}  // namespace swiftlet::apps
