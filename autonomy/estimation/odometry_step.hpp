// The result of one odometry step, as values for the filter.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// The pose relative to the filter's clone of its pose at `from`; see perception::ErrorStateFilter::addRelativePose.
struct RelativePoseMeasurement {
  common::Time from;
  common::Time to;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();   ///< Of (x_m, y_m, yaw_rad) in the frame at `from`.
  std::optional<Eigen::Vector2d> unobservable_direction;  ///< Direction without information, in the frame at `from`.
};

/// What a camera measures: the pose in space relative to the filter's clone of its pose at `from`; see
/// perception::ErrorStateFilter::addRelativePose3.
struct SpatialPoseMeasurement {
  common::Time from;
  common::Time to;
  common::Pose3 T_from_to;
  /// Of the error (position, rotation vector) in the axes of the body at `to`.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
};

/// What a camera tells the filter with one frame: a measurement, then the clone from which the next ones start.
struct CameraStep {
  std::optional<SpatialPoseMeasurement> measurement;
  std::optional<common::Time> clone_after;
};

/// The filter applies it in the order clone_before, measurement, clone_after. A scan that did not match gives an empty
/// step.
struct OdometryStep {
  bool matched = false;
  bool interrupted = false;  ///< The odometry was lost and restarts with this scan.
  /// Covariance that this step adds to the drift, (x_m, y_m, yaw_rad) with the axes of the body. Zero while the
  /// reference scan does not change. Nothing along a direction that the scan does not fix: see StepUncertainty.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  std::optional<common::Time> clone_before;  ///< Time of the pose that the measurement starts from.
  std::optional<RelativePoseMeasurement> measurement;
  std::optional<common::Time> clone_after;  ///< Time of the pose that the next measurements start from.
};

}  // namespace swiftlet::autonomy
