// Path problems with known optimal lengths, solved by D* Lite.
#pragma once

#include <string>

namespace swiftlet::apps {

struct PlanProblemsOptions {
  std::string map;       ///< A .map of the Moving AI benchmarks.
  std::string problems;  ///< Its .scen.
  bool json = false;
};

/// Returns the exit code: a length that is not the optimal one is a failure. Throws InputError.
int planProblems(const PlanProblemsOptions& options);

}  // namespace swiftlet::apps
