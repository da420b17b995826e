// Path problems with known optimal lengths, solved by D* Lite in the plane and by A* over voxels.
#pragma once

#include <string>

namespace swiftlet::apps {

struct PlanProblemsOptions {
  std::string map;       ///< A .map of the Moving AI benchmarks, or a .3dmap.
  std::string problems;  ///< Its .scen or .3dscen.
  int drawn = 0;         ///< Problems that are drawn evenly by the seed; 0: all are solved.
  int seed = 0;
  bool json = false;
};

/// Returns the exit code: a length that is not the optimal one is a failure. Throws InputError.
int planProblems(const PlanProblemsOptions& options);

}  // namespace swiftlet::apps
