// A pose in the map with its covariance.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// The vehicle's pose in the map, with the covariance of the additive errors (x_m, y_m, yaw_rad), axes of the map.
struct UncertainPose {
  common::Pose2 T_map_body;
  Eigen::Matrix3d covariance;
};

/// The pose by motion and the pose by a match, fused by their covariances. The match alone would be less certain: over
/// a metre the odometry matches about forty scans, so it knows better than one match how the vehicle has turned.
UncertainPose weightedMean(const UncertainPose& moved, const UncertainPose& matched);

}  // namespace swiftlet::perception
