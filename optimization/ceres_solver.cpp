#include "optimization/ceres_solver.hpp"

#include <algorithm>

namespace swiftlet::optimization {

ceres::Solver::Summary solve(ceres::Problem& problem, const PoseGraphConfig& config) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = config.max_iterations;
  options.initial_trust_region_radius = config.trust_radius;
  options.function_tolerance = config.relative_decrease;
  options.num_threads = 1;
  options.max_solver_time_in_seconds = 1e9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

int stepsTried(const ceres::Solver::Summary& summary) {
  return std::max(0, static_cast<int>(summary.iterations.size()) - 1);  // The first evaluates the guess.
}

}  // namespace swiftlet::optimization
