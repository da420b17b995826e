#include "autonomy/estimation/position_uncertainty.hpp"

namespace swiftlet::autonomy {

Eigen::Matrix3d PositionUncertainty::ofStep(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body) {
  return matched ? step_.add(step, T_odom_body, planar()) : step.covariance;
}

/// The filter's covariance of (x_m, y_m, yaw_rad), in odom.
Eigen::Matrix3d PositionUncertainty::planar() const {
  constexpr int kPlanar[] = {0, 1, 8};  // Position in x and y, attitude about the vertical.
  const Eigen::Matrix<double, 15, 15> all = filter_.estimate().covariance;
  Eigen::Matrix3d planar;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) planar(i, k) = all(kPlanar[i], kPlanar[k]);
  return planar;
}

double PositionUncertainty::add(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body,
                                const MapStep& map) {
  PositionFix fix;
  fix.stamp = filter_.newest();
  fix.covariance_odom_m2 = horizontal_m2();
  // A restart of the odometry does not measure the motion before it.
  fix.matched = matched && !step.interrupted;
  if (const auto unobservable = unobservableMotion(step, T_odom_body)) {
    fix.unobservable_direction_odom = unobservable->change.head<2>().stableNormalized();
    fix.turns = !isTranslation(*unobservable);
  }
  fix.new_reference = matched && !step.covariance.isZero();
  if (map.at_key) fix.newest_key = map.at_key->key;
  fix.known_key = map.known_key;
  return drift_m_ = drift_.add(fix);
}

}  // namespace swiftlet::autonomy
