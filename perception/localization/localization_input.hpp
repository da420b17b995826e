// What the localizer is given with each scan.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

struct LocalizationInput {
  /// In the level frame of the body; its own T_odom_body is not read.
  const ProjectedScan& scan;
  common::Pose2 T_odom_body;  ///< An input without a finite one is passed over.
  /// Of the odometry since the last input, (x_m, y_m, yaw_rad) with the axes of the body then. One that is not finite
  /// says nothing: the step is taken for very uncertain.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  bool fresh = true;  ///< The odometry was not made of this scan: it may weigh.
  /// The odometry does not know how the vehicle came here from where it was; what it may be off by is added.
  bool interrupted = false;
};

}  // namespace swiftlet::perception
