// The input of the localizer for each scan.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

struct LocalizationInput {
  /// In the level frame of the body. Its own T_odom_body is not used.
  const ProjectedScan& scan;
  common::Pose2 T_odom_body;  ///< An input with a non-finite pose is skipped.
  /// Covariance of the odometry step since the last input: (x_m, y_m, yaw_rad) along the axes of the body at that
  /// input. If it is not finite, the step counts as very uncertain.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  bool fresh = true;  ///< The odometry did not use this scan, so it may weigh the particles.
  /// The odometry lost track since the last input; the covariance of an unknown step is added.
  bool interrupted = false;
};

}  // namespace swiftlet::perception
