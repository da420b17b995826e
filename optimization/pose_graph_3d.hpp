// Pose graphs in space: the poses that best satisfy relative measurements, by sparse Levenberg-Marquardt (Ceres) on
// unit quaternions. Deterministic: one thread, bounded by iterations, never by time. Pure function, safe from any
// thread.
//
// chi2 is the sum over the edges of e' * information * e with the error of g2o (Kuemmerle 2011): of the measurement's
// inverse times the relative pose of the estimate, the translation and the vector part of the unit quaternion whose w
// is not negative, which for small angles is half the rotation vector. No factor 1/2, no factor 2.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "optimization/graph_3d.hpp"
#include "optimization/pose_graph_config.hpp"

namespace swiftlet::optimization {

/// If no edge connects a group of poses to a fixed one, the first of the group stays where it is and the others are
/// placed relative to it. Indices must be valid.
PoseGraphSolution<common::Pose3> optimize(const PoseGraph3D& graph, const PoseGraphConfig& config);

}  // namespace swiftlet::optimization
