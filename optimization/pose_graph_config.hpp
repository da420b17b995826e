// How pose graphs are optimized, those of the plane and those of space, and the result.
#pragma once

#include <vector>

namespace swiftlet::optimization {

struct PoseGraphConfig {
  int max_iterations = 30;  ///< Iterations after which the optimization stops.
  double robust_width =
      3.0;  ///< Normalized error, in standard deviations, beyond which a loop closure loses influence (Cauchy kernel).
  double relative_decrease = 1e-6;  ///< The optimization has converged when the cost changes by less than this share.
  /// The first radius of the trust region, which bounds the first step; 1e16 makes that a step of Gauss-Newton. It is
  /// no setting: only optimizeFromBestStart() needs another than the default of Ceres
  /// (Solver::Options::initial_trust_region_radius), which this is.
  double trust_radius = 1e4;
};

template <typename Pose>
struct PoseGraphSolution {
  std::vector<Pose> poses;
  /// Of each edge at the solution: e' * information * e, with 3 degrees of freedom in the plane and 6 in space.
  std::vector<double> squared_errors;
  int iterations = 0;      ///< Steps tried.
  bool converged = false;  ///< False: stopped by max_iterations or not solvable; `poses` are the best found.
};

}  // namespace swiftlet::optimization
