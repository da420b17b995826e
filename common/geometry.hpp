// Rigid transforms. Frames follow REP-103/105: ENU world, FLU body, metres, radians.
// T_a_b takes coordinates in b to a: point_a = T_a_b * point_b; T_a_c = T_a_b * T_b_c.
#pragma once

#include <numbers>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace swiftlet::common {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// The angle wrapped to (-pi, pi]. NaN for NaN and infinity.
double wrapAngle(double angle_rad);

/// A pose in the plane, an element of SE(2).
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;

  Eigen::Vector2d position_m() const { return {x_m, y_m}; }
  Pose2 inverse() const;
  Pose2 operator*(const Pose2& other) const;
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const;
};

/// A pose in space, an element of SE(3).
struct Pose3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();

  Pose3 inverse() const;
  Pose3 operator*(const Pose3& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const;
};

/// Intrinsic z-y-x Euler angles: R = Rz(yaw) * Ry(pitch) * Rx(roll). Pitch is in [-pi/2, pi/2].
struct RollPitchYaw {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

RollPitchYaw rollPitchYaw(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond quaternionFrom(const RollPitchYaw& angles);
double yawOf(const Eigen::Quaterniond& rotation);
/// The cosine of the angle between the body's z axis and the vertical. Rounding may make it slightly greater than 1.
double cosTilt(const Eigen::Quaterniond& rotation);

bool isFinite(const Pose2& pose);
bool isFinite(const Pose3& pose);

/// The projection on the plane: x, y and yaw.
Pose2 planar(const Pose3& pose);
/// The planar pose lifted to height z, without roll and pitch.
Pose3 lifted(const Pose2& pose, double z_m);

/// Converts the covariance of an error (x_m, y_m, yaw_rad) from frame b to frame a; `yaw_rad` is the yaw of b in a.
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double yaw_rad);

/// The covariance of (x_m, y_m, yaw_rad) without the variance of the position along a unit vector of the same frame;
/// all of it if there is no such direction.
Eigen::Matrix3d withoutVarianceAlong(const std::optional<Eigen::Vector2d>& direction,
                                     const Eigen::Matrix3d& covariance);

/// Covariance of the additive errors (x_m, y_m, yaw_rad), independent of each other, of these standard deviations.
Eigen::Matrix3d planarCovariance(double position_sigma_m, double yaw_sigma_rad);

/// The pose of b in a.
Pose2 between(const Pose2& T_map_a, const Pose2& T_map_b);
/// The covariance of the pose after a step from `from` to `to`. The yaw error before the step displaces its end, and
/// the step adds its own covariance. All covariances are of (x_m, y_m, yaw_rad), with the axes of the frame of both
/// poses.
Eigen::Matrix3d propagated(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to,
                           const Eigen::Matrix3d& step_covariance);

/// Converts a rotation vector to a unit quaternion, and back; small angles are exact to second order.
Eigen::Quaterniond expSO3(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d logSO3(const Eigen::Quaterniond& rotation);
/// skew(v) * u = v x u.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

}  // namespace swiftlet::common
