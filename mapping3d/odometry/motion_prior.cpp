#include "mapping3d/odometry/motion_prior.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::mapping3d {
namespace {

/// Standard deviations of the acceleration and the angular acceleration; they bound the steps and the turns where
/// little is seen.
constexpr double kAcceleration_m_s2 = 5.0, kAngularAcceleration_rad_s2 = 10.0;
/// Shorter gaps are mostly the jitter of the stamps (those of arrival over a link come in bursts). The motion in them
/// is as uncertain as over kJitter_s.
constexpr double kLeastGap_s = 0.01;
constexpr double kJitter_s = 0.045;

}  // namespace

CameraVelocity motionBetween(const common::Pose3& T_map_from, const common::Pose3& T_map_to, double gap_s) {
  if (gap_s <= 0.0) return {};
  const common::Pose3 step = T_map_from.inverse() * T_map_to;
  const double bounded_s = std::max(gap_s, kLeastGap_s);
  return {step.position_m / bounded_s, common::logSO3(step.rotation) / bounded_s};
}

Matrix6d motionInformation(double gap_s) {
  const double squared_s2 = std::pow(gap_s < kLeastGap_s ? kJitter_s : gap_s, 2);
  const double sigma_m = 0.5 * kAcceleration_m_s2 * squared_s2;
  const double sigma_rad = 0.5 * kAngularAcceleration_rad_s2 * squared_s2;
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
  information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return information;
}

}  // namespace swiftlet::mapping3d
