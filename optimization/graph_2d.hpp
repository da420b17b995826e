// A pose graph in the plane, as a value.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::optimization {

/// "Seen from pose `from`, pose `to` stands at T_from_to."
struct PoseEdge2D {
  int from = 0;
  int to = 0;
  common::Pose2 T_from_to;
  /// Inverse covariance of the additive errors (x_m, y_m, yaw_rad) of T_from_to; symmetric positive definite.
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool robust = false;  ///< May be wrong (a loop closure): its pull is bounded by the robust kernel.
};

struct PoseGraph2D {
  std::vector<common::Pose2> poses;  ///< The initial guess.
  std::vector<PoseEdge2D> edges;
  int fixed = 0;                     ///< Index of a pose that does not move.
  std::vector<int> also_fixed = {};  ///< Indices of further poses that do not move.
};

}  // namespace swiftlet::optimization
