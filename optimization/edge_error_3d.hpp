// The error of one edge of a pose graph in space, and its derivatives. Pure function, safe from any thread.
#pragma once

#include <Eigen/Core>

#include "optimization/graph_3d.hpp"

namespace swiftlet::optimization {

/// The error of an edge and its Jacobians with respect to (x, y, z, qx, qy, qz, qw) of each pose, for steps that keep
/// the quaternion's length of 1.
struct EdgeError3D {
  Vector6d error;
  Eigen::Matrix<double, 6, 7> jacobian_from;
  Eigen::Matrix<double, 6, 7> jacobian_to;
};
EdgeError3D edgeError(const common::Pose3& from, const common::Pose3& to, const common::Pose3& T_from_to);

}  // namespace swiftlet::optimization
