// How uncertain the motion between two scans is, also along a direction that they do not fix.
//
// Along a bare wall the filter moves by inertia. Its variance there grows by as much as the motion is uncertain; once a
// scan fixes the position again it shrinks by the variance of the correction, which for the map is a motion too. A map
// that took either for certain would bend to it, and a place seen again could not put it right.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "autonomy/estimation/odometry_step.hpp"
#include "common/geometry.hpp"

namespace swiftlet::autonomy {

/// Unit vector in odom along which the step did not fix the position; none if it fixed every direction.
std::optional<Eigen::Vector2d> unobservableDirection(const OdometryStep& step, const common::Pose2& T_odom_body);

/// One thread.
class StepUncertainty {
 public:
  /// For each scan that matched. `covariance_odom_m2`: the filter's, of the horizontal position, after the scan.
  /// Returns the covariance of the motion since the last call, (x_m, y_m, yaw_rad) with the axes of the body.
  Eigen::Matrix3d add(const OdometryStep& step, const common::Pose2& T_odom_body,
                      const Eigen::Matrix2d& covariance_odom_m2);

 private:
  Eigen::Matrix2d unobserved_m2(const Eigen::Matrix2d& covariance_odom_m2,
                                const std::optional<Eigen::Vector2d>& direction_odom);

  Eigen::Matrix2d covariance_odom_m2_ = Eigen::Matrix2d::Zero();  ///< The filter's, after the last scan.
  std::optional<Eigen::Vector2d> direction_odom_;                 ///< Unobservable in the last scan.
};

}  // namespace swiftlet::autonomy
