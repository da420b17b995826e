// How pose graphs are optimized, those of the plane and those of space.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"

namespace swiftlet::optimization {

struct PoseGraphConfig {
  int max_iterations = 30;
  double robust_width = 3.0;        ///< Normalized error (sigmas) beyond which a robust edge loses influence (Cauchy).
  double relative_decrease = 1e-6;  ///< Converged when the cost changes by less than this share.
  /// The trust region's first radius: how far the first step may go, 1e16 for that of Gauss-Newton. Not read from
  /// files.
  double trust_radius = 1e4;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::optimization
