// How uncertain the motion between two scans is, also along a motion that they do not show.
//
// Along a bare wall the filter moves by inertia. Its variance there grows by as much as the motion is uncertain; once a
// scan fixes the position again it shrinks by the variance of the correction, which for the map is a motion too. A map
// that took either for certain would bend to it, and a place seen again could not put it right.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "autonomy/estimation/odometry_step.hpp"
#include "common/geometry.hpp"
#include "common/unobservable_motion.hpp"

namespace swiftlet::autonomy {

/// The motion that the step did not show, along the axes of odom; none if it showed all.
std::optional<common::UnobservableMotion> unobservableMotion(const OdometryStep& step,
                                                             const common::Pose2& T_odom_body);

/// One thread.
class StepUncertainty {
 public:
  /// For each scan that matched. `covariance_odom`: the filter's, of (x_m, y_m, yaw_rad), after the scan.
  /// Returns the covariance of the motion since the last call, (x_m, y_m, yaw_rad) with the axes of the body.
  Eigen::Matrix3d add(const OdometryStep& step, const common::Pose2& T_odom_body,
                      const Eigen::Matrix3d& covariance_odom);
  /// For a scan that did not match, while another sensor measures the motion. Returns by how much the filter's
  /// covariance has grown since the last call, in the directions in which it has, as add() does.
  Eigen::Matrix3d grown(const common::Pose2& T_odom_body, const Eigen::Matrix3d& covariance_odom);

 private:
  Eigen::Matrix3d unobserved(const Eigen::Matrix3d& covariance_odom,
                             const std::optional<common::UnobservableMotion>& motion_odom);

  Eigen::Matrix3d covariance_odom_ = Eigen::Matrix3d::Zero();    ///< The filter's, after the last scan.
  std::optional<common::UnobservableMotion> unobservable_odom_;  ///< In the last scan.
};

}  // namespace swiftlet::autonomy
