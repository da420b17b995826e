#include "optimization/pose_graph_config.hpp"

#include "common/validation.hpp"

namespace swiftlet::optimization {

void PoseGraphConfig::describe(common::config::Fields& fields) {
  fields("max_iterations", max_iterations, "Iterations after which the optimization stops.");
  fields("robust_width", robust_width, "Normalized error beyond which a loop closure loses influence.");
  fields("relative_decrease", relative_decrease, "Converged when the cost changes by less than this share.");
}

std::vector<std::string> PoseGraphConfig::validate() const {
  return common::Validation()
      .within("max_iterations", max_iterations, 1, 1000)
      .within("robust_width", robust_width, 0.1, 100)
      .within("relative_decrease", relative_decrease, 1e-15, 0.1)
      .problems();
}

}  // namespace swiftlet::optimization
