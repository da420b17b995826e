// A pose graph in space, as a value.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::optimization {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// "Seen from pose `from`, pose `to` stands at T_from_to."
struct PoseEdge3D {
  int from = 0;
  int to = 0;
  common::Pose3 T_from_to;
  /// Inverse covariance of the error (x_m, y_m, z_m, qx, qy, qz), see above; symmetric positive definite.
  Matrix6d information = Matrix6d::Identity();
  bool robust = false;  ///< May be wrong (a loop closure): its pull is bounded by the robust kernel.
};

struct PoseGraph3D {
  std::vector<common::Pose3> poses;  ///< The initial guess; unit quaternions.
  std::vector<PoseEdge3D> edges;
  std::vector<int> fixed = {0};  ///< Indices of the poses that do not move.
};

}  // namespace swiftlet::optimization
