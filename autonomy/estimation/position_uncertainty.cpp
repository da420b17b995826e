#include "autonomy/estimation/position_uncertainty.hpp"

namespace swiftlet::autonomy {

Eigen::Matrix3d PositionUncertainty::ofStep(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body) {
  return matched ? step_.add(step, T_odom_body, horizontal_m2()) : step.covariance;
}

double PositionUncertainty::add(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body,
                                const MapStep& map) {
  PositionFix fix;
  fix.stamp = filter_.newest();
  fix.covariance_odom_m2 = horizontal_m2();
  // A restart of the odometry does not measure the motion before it.
  fix.matched = matched && !step.interrupted;
  fix.unobservable_direction_odom = unobservableDirection(step, T_odom_body);
  fix.new_reference = matched && !step.covariance.isZero();
  if (map.at_key) fix.newest_key = map.at_key->key;
  fix.known_key = map.known_key;
  return drift_m_ = drift_.add(fix);
}

}  // namespace swiftlet::autonomy
