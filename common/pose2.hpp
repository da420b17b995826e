// Poses in the plane and the covariances of their errors. Frames follow REP-103/105: ENU world, FLU body, metres,
// radians. T_a_b takes coordinates in b to a: point_a = T_a_b * point_b; T_a_c = T_a_b * T_b_c.
#pragma once

#include <numbers>
#include <optional>

#include <Eigen/Core>

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

bool isFinite(const Pose2& pose);

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

}  // namespace swiftlet::common
