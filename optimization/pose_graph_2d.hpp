// Pose graphs in the plane: the poses that best satisfy relative measurements, by sparse Levenberg-Marquardt (Ceres).
// Deterministic: one thread, bounded by iterations, never by time. Pure function, safe from any thread.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "optimization/graph_2d.hpp"
#include "optimization/pose_graph_config.hpp"

namespace swiftlet::optimization {

/// Poses that no edge connects to the fixed one stay where they were (a slight prior holds them). Indices must be
/// valid.
PoseGraphSolution<common::Pose2> optimize(const PoseGraph2D& graph, const PoseGraphConfig& config);

/// The error of an edge, (R_from' (t_to - t_from) - t, yaw), and its Jacobians with respect to (x, y, yaw) of each
/// pose.
struct EdgeError2D {
  Eigen::Vector3d error;
  Eigen::Matrix3d jacobian_from;
  Eigen::Matrix3d jacobian_to;
};
EdgeError2D edgeError(const common::Pose2& from, const common::Pose2& to, const common::Pose2& T_from_to);

}  // namespace swiftlet::optimization
