// What is known of a camera's motion since its last frame without any other sensor: the velocities stay the same, up to
// bounds of the acceleration.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "mapping3d/odometry/alignment.hpp"

namespace swiftlet::mapping3d {

/// A velocity is not extrapolated over a longer gap.
constexpr double kLongestPrediction_s = 0.5;

struct CameraVelocity {
  Eigen::Vector3d velocity_camera_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_camera_rad_s = Eigen::Vector3d::Zero();

  /// Where the camera is after that time, seen from where it was.
  common::Pose3 over(double gap_s) const {
    return {common::expSO3(gap_s * rate_camera_rad_s), gap_s * velocity_camera_m_s};
  }
};

/// Zero if no time has passed.
CameraVelocity motionBetween(const common::Pose3& T_map_from, const common::Pose3& T_map_to, double gap_s);

/// The information on a predicted motion over a gap from the bounds of the acceleration, as PosePrior::information.
Matrix6d motionInformation(double gap_s);

}  // namespace swiftlet::mapping3d
