// Rigid transforms in space and their rotations; those in the plane are in common/pose2.hpp. Frames follow REP-103/105:
// ENU world, FLU body, metres, radians. T_a_b takes coordinates in b to a: point_a = T_a_b * point_b; T_a_c = T_a_b *
// T_b_c.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/pose2.hpp"

namespace swiftlet::common {

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

bool isFinite(const Pose3& pose);

/// The projection on the plane: x, y and yaw.
Pose2 planar(const Pose3& pose);
/// The planar pose lifted to height z, without roll and pitch.
Pose3 lifted(const Pose2& pose, double z_m);

/// Converts a rotation vector to a unit quaternion, and back; small angles are exact to second order.
Eigen::Quaterniond expSO3(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d logSO3(const Eigen::Quaterniond& rotation);
/// skew(v) * u = v x u.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

}  // namespace swiftlet::common
