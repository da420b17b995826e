// The result of one odometry step, as values for the filter.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/fusion/measurement.hpp"

namespace swiftlet::autonomy {

/// What a camera tells the filter with one frame: a measurement, then the clone from which the next ones start.
struct CameraStep {
  std::optional<perception::Measurement> measurement;
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
  std::optional<perception::Measurement> measurement;
  std::optional<common::Time> clone_after;  ///< Time of the pose that the next measurements start from.
};

}  // namespace swiftlet::autonomy
