// A pose in the map and how well it is known.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Where the vehicle is in the map; covariance of the additive errors (x_m, y_m, yaw_rad).
struct UncertainPose {
  common::Pose2 T_map_body;
  Eigen::Matrix3d covariance;
};

/// What the motion and a match say of the same pose, each by its covariance: over a metre the odometry, which is
/// matched forty times, knows better than one match how the vehicle has turned.
UncertainPose weightedMean(const UncertainPose& moved, const UncertainPose& matched);

}  // namespace swiftlet::perception
