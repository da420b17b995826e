// A motion in the plane that a scan does not show: a translation along a corridor, a turn about the middle of a round
// room. One of SE(2), as a small change of the body's pose.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/pose2.hpp"

namespace swiftlet::common {

struct UnobservableMotion {
  /// Change of the body's pose (x_m, y_m, yaw_rad), along the axes of some frame. Only its direction matters; it is not
  /// zero.
  Eigen::Vector3d change = Eigen::Vector3d::UnitX();
  /// Distance of the seen points from the body, root mean square, > 0: a turn moves them by this times its angle, which
  /// makes turns and translations comparable.
  double lever_m = 1.0;
};

/// Finite and not zero, with a lever.
bool isValid(const UnobservableMotion& motion);
/// Whether it moves the points more by its translation than by its turn.
bool isTranslation(const UnobservableMotion& motion);

/// The same motion along the axes of frame a; `yaw_rad` is the yaw of its present frame in a.
UnobservableMotion turned(const UnobservableMotion& motion, double yaw_rad);
/// The same motion of the plane, as the change of a body that is `offset_m` away from this one: what turns about a
/// point moves two bodies differently.
UnobservableMotion movedBy(const UnobservableMotion& motion, const Eigen::Vector2d& offset_m);

/// A row that gives how much of the motion is in a change of the pose: 1 for its own, 0 for those that move the points
/// otherwise.
Eigen::RowVector3d shareAlong(const UnobservableMotion& motion);
/// Two rows that are zero for the motion and, with it, describe every change of the pose, in metres: what was seen.
Eigen::Matrix<double, 2, 3> rowsAcross(const UnobservableMotion& motion);
/// The smallest change of the pose (x_m, y_m, yaw_rad) of which rowsAcross() makes `across_m`.
Eigen::Vector3d changeAcross(const UnobservableMotion& motion, const Eigen::Vector2d& across_m);
/// The cosine of the angle between two motions of the same body, by the displacements of the points; without its sign.
double likeness(const UnobservableMotion& a, const UnobservableMotion& b);

/// The covariance of (x_m, y_m, yaw_rad) without the variance along the motion; all of it if there is none.
Eigen::Matrix3d withoutVarianceAlong(const std::optional<UnobservableMotion>& motion,
                                     const Eigen::Matrix3d& covariance);

}  // namespace swiftlet::common
