// How pose graphs are optimized, those of the plane and those of space.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::optimization {

struct PoseGraphConfig {
  int max_iterations = 30;
  double robust_width = 3.0;
  double relative_decrease = 1e-6;
  /// The first radius of the trust region, which bounds the first step; 1e16 makes that a step of Gauss-Newton. It is
  /// no setting: only optimizeFromBestStart() needs another than the default of Ceres
  /// (Solver::Options::initial_trust_region_radius), which this is.
  double trust_radius = 1e4;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::optimization
