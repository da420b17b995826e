// How uncertain the position is: since the last scan, and since the take-off.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "autonomy/estimation/drift_monitor.hpp"
#include "autonomy/estimation/map_pipeline.hpp"
#include "autonomy/estimation/odometry_step.hpp"
#include "autonomy/estimation/step_uncertainty.hpp"
#include "common/geometry.hpp"
#include "perception/fusion/error_state_filter.hpp"

namespace swiftlet::autonomy {

/// One thread. Refers to the filter.
class PositionUncertainty {
 public:
  explicit PositionUncertainty(const perception::ErrorStateFilter& filter) : filter_(filter) {}

  /// Covariance of the motion since the last scan, (x_m, y_m, yaw_rad) with the axes of the body; `matched`: the filter
  /// accepted the match.
  Eigen::Matrix3d ofStep(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body);
  /// The same where another sensor than the laser measured it: by how much less certain the filter has become.
  Eigen::Matrix3d ofMotion(const common::Pose2& T_odom_body) { return step_.grown(T_odom_body, planar()); }
  /// Adds the position by the scan, after it is in the map. Returns the drift.
  double add(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body, const MapStep& map);
  /// See DriftMonitor; as of the last scan that was matched or tried.
  double drift_m() const { return drift_m_; }

 private:
  Eigen::Matrix2d horizontal_m2() const { return filter_.state().position_covariance_m2.topLeftCorner<2, 2>(); }
  Eigen::Matrix3d planar() const;

  const perception::ErrorStateFilter& filter_;
  StepUncertainty step_;
  DriftMonitor drift_;
  double drift_m_ = 0.0;
};

}  // namespace swiftlet::autonomy
