// What an odometry says of one step of the motion, as values for the filter.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// Relative to the filter's clone of its pose at `from`; see perception::ErrorStateFilter::addRelativePose.
struct RelativePoseMeasurement {
  common::Time from;
  common::Time to;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of (x_m, y_m, yaw_rad) in the frame at `from`.
  std::optional<Eigen::Vector2d> unseen_direction;       ///< In the frame at `from`; along it nothing was measured.
};

/// The filter takes it in from the top: clone, measurement, clone. A scan that did not match gives an empty step.
struct OdometryStep {
  bool matched = false;
  bool interrupted = false;  ///< It was lost, and begins anew with this scan.
  /// What this step adds to the drift, (x_m, y_m, yaw_rad) with the axes of the body. Zero within one reference.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  std::optional<common::Time> clone_before;  ///< Of the pose that the measurement starts from.
  std::optional<RelativePoseMeasurement> measurement;
  std::optional<common::Time> clone_after;  ///< Of the pose that the next measurements start from.
};

}  // namespace swiftlet::autonomy
