// The estimated state of the vehicle.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// Standard deviation of the height of the body origin while the vehicle stands on the take-off floor.
inline constexpr double kStandingHeightSigma_m = 0.02;

/// The estimate at one time. `T_odom_body` is continuous; `T_map_odom` may jump when the SLAM corrects.
/// The origin of both frames is the take-off pose; z is the height above the take-off floor.
struct VehicleState {
  Time stamp;
  Pose3 T_odom_body;
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_body_rad_s = Eigen::Vector3d::Zero();
  Pose2 T_map_odom;

  Eigen::Matrix3d position_covariance_m2 = Eigen::Matrix3d::Zero();     ///< In odom.
  Eigen::Matrix3d velocity_covariance_m2_s2 = Eigen::Matrix3d::Zero();  ///< In odom.

  double height_above_ground_m = 0.0;  ///< Over the surface directly below (table, floor).
  bool horizontal_valid = false;       ///< x, y, yaw and their velocities may be used for control.
  bool vertical_valid = false;         ///< z and its velocity may be used for control.

  /// When a measurement of any sensor last supported x, y and yaw, or z; Time{} before the first. It is the time when
  /// the measurement was processed, so the state does not age by a sensor that is late but keeps measuring.
  Time horizontal_supported;
  Time vertical_supported;

  double horizontalAge_s(Time now) const { return (now - horizontal_supported).seconds(); }
  double verticalAge_s(Time now) const { return (now - vertical_supported).seconds(); }
  /// Time since the newest inertial sample, to which the state was propagated.
  double inertialAge_s(Time now) const { return (now - stamp).seconds(); }

  Pose3 T_map_body() const { return lifted(T_map_odom, 0.0) * T_odom_body; }
  Pose2 T_map_body_planar() const { return planar(T_map_body()); }
  Eigen::Vector3d velocity_map_m_s() const { return lifted(T_map_odom, 0.0).rotation * velocity_odom_m_s; }
};

}  // namespace swiftlet::common
