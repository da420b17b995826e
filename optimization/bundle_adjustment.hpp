// Bundle adjustment: poses and the landmarks seen from them, together. Each observation is a point in space with its
// covariance, as a camera with depth gives it.
//
// Source: R. Kuemmerle et al., "g2o: A general framework for graph optimization", ICRA 2011; solved by Ceres.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "optimization/graph_3d.hpp"
#include "optimization/pose_graph_config.hpp"

namespace swiftlet::optimization {

/// Seen from pose `pose`, a landmark is at this point in the axes of the pose. Both are indices.
struct PointObservation {
  int pose = 0;
  int landmark = 0;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();  ///< Positive definite.
};

/// What another sensor says of a pose.
struct MeasuredPose3D {
  int pose = 0;
  common::Pose3 T_map_measured;
  /// Inverse covariance of the error (x, y, z, rotation vector) in the axes of the measured pose; positive definite.
  Matrix6d information = Matrix6d::Identity();
};

struct Bundle {
  std::vector<common::Pose3> poses;  ///< The initial guess; unit quaternions.
  std::vector<Eigen::Vector3d> landmarks_m;
  std::vector<PointObservation> observations;
  std::vector<MeasuredPose3D> measured;
  std::vector<int> fixed = {0};  ///< Indices of the poses that do not move.
};

/// Sum of the squared errors of all observations and measured poses, each over its expected one.
double squaredError(const Bundle& bundle);

/// Moves the poses and the landmarks to the least error. Observations have a Cauchy kernel of `robust_width`. An
/// unsolvable bundle stays as it is. Equal bundles give equal bits.
void adjust(Bundle& bundle, const PoseGraphConfig& config);

}  // namespace swiftlet::optimization
