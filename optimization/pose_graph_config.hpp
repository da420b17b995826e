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
  /// The trust region's first radius: how far the first step may go, 1e16 for that of Gauss-Newton. Not read from
  /// files.
  double trust_radius = 1e4;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::optimization
