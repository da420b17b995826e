#include "optimization/pose_graph_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::optimization {

void PoseGraphConfig::describe(common::config::Fields& fields) {
  fields("max_iterations", max_iterations, {1, 1000}, "Iterations after which the optimization stops.");
  fields("robust_width", robust_width, {0.1, 100},
         "Normalized error, in standard deviations, beyond which a loop closure loses influence (Cauchy kernel).");
  fields("relative_decrease", relative_decrease, {1e-15, 0.1},
         "The optimization has converged when the cost changes by less than this share.");
}

}  // namespace swiftlet::optimization
