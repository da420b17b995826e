// Constraints of the pose graph.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// A constraint between two key scans, from a match or from the motion between them.
struct SlamEdge {
  int from = 0;
  int to = 0;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< Of (x_m, y_m, yaw_rad) in the frame of `from`.
  /// Whether it is a loop closure.
  bool loop = false;
};

/// An accepted loop closure, for the record.
struct LoopClosure {
  int from = 0;  ///< Indices of key scans.
  int to = 0;
  common::Pose2 T_from_to;
  double quality = 0.0;
  double shift_m = 0.0;  ///< Distance of the pose by this closure from the estimate before.
};

}  // namespace swiftlet::perception
