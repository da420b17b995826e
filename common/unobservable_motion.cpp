#include "common/unobservable_motion.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::common {
namespace {

using Eigen::Vector3d;

/// A change of the pose as a displacement of the points.
Vector3d displaced(const Vector3d& change, double lever_m) { return {change.x(), change.y(), lever_m * change.z()}; }

/// Two displacements that are orthogonal to the motion and to each other.
Eigen::Matrix<double, 3, 2> acrossOf(const UnobservableMotion& motion) {
  const Vector3d along = displaced(motion.change, motion.lever_m).normalized();
  // Across the motion in the plane if it has a direction there, so that a corridor keeps its own axes.
  const Vector3d first =
      (along.head<2>().squaredNorm() > 1e-12 ? Vector3d(-along.y(), along.x(), 0.0) : Vector3d::UnitX()).normalized();
  Eigen::Matrix<double, 3, 2> across;
  across << first, along.cross(first);
  return across;
}

}  // namespace

bool isValid(const UnobservableMotion& motion) {
  return motion.change.allFinite() && motion.change.squaredNorm() > 0.0 && std::isfinite(motion.lever_m) &&
         motion.lever_m > 0.0;
}

bool isTranslation(const UnobservableMotion& motion) {
  return motion.change.head<2>().norm() > motion.lever_m * std::abs(motion.change.z());
}

UnobservableMotion turned(const UnobservableMotion& motion, double yaw_rad) {
  UnobservableMotion result = motion;
  result.change.head<2>() = Eigen::Rotation2Dd(yaw_rad) * motion.change.head<2>();
  return result;
}

UnobservableMotion movedBy(const UnobservableMotion& motion, const Eigen::Vector2d& offset_m) {
  UnobservableMotion result = motion;
  result.change.head<2>() += motion.change.z() * Eigen::Vector2d(-offset_m.y(), offset_m.x());
  return result;
}

Eigen::RowVector3d shareAlong(const UnobservableMotion& motion) {
  const Vector3d along = displaced(motion.change, motion.lever_m);
  return displaced(along, motion.lever_m).transpose() / along.squaredNorm();
}

Eigen::Matrix<double, 2, 3> rowsAcross(const UnobservableMotion& motion) {
  return acrossOf(motion).transpose() * Vector3d(1.0, 1.0, motion.lever_m).asDiagonal();
}

Vector3d changeAcross(const UnobservableMotion& motion, const Eigen::Vector2d& across_m) {
  return displaced(acrossOf(motion) * across_m, 1.0 / motion.lever_m);
}

double likeness(const UnobservableMotion& a, const UnobservableMotion& b) {
  return std::abs(displaced(a.change, b.lever_m).normalized().dot(displaced(b.change, b.lever_m).normalized()));
}

Eigen::Matrix3d withoutVarianceAlong(const std::optional<UnobservableMotion>& motion,
                                     const Eigen::Matrix3d& covariance) {
  if (!motion) return covariance;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - motion->change * shareAlong(*motion);
  return across * covariance * across.transpose();
}

}  // namespace swiftlet::common
