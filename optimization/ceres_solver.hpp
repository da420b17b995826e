// How problems are given to Ceres. For sources only: users of the library need no Ceres.
#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "optimization/pose_graph_config.hpp"

namespace swiftlet::optimization {

/// By sparse Levenberg-Marquardt. The same problem gives the same bits: one thread, bounded by iterations, never by
/// time.
ceres::Solver::Summary solve(ceres::Problem& problem, const PoseGraphConfig& config);

/// 0 where nothing could move.
int stepsTried(const ceres::Solver::Summary& summary);

}  // namespace swiftlet::optimization
