// The constraints of the pose graph.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// A constraint between two key scans: a match, or the motion between them.
struct SlamEdge {
  int from = 0;
  int to = 0;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< Of (x_m, y_m, yaw_rad) in the frame of `from`.
  bool loop = false;
};

struct LoopClosure {
  int from = 0;  ///< Key scans.
  int to = 0;
  common::Pose2 T_from_to;
  double quality = 0.0;
  double shift_m = 0.0;  ///< How far the closure lies from what was believed.
};

}  // namespace swiftlet::perception
