#include "perception/fusion/filter_state.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"

namespace swiftlet::perception::fusion {
namespace {

void rotateBy(Eigen::Quaterniond& rotation, const Eigen::Vector3d& error_rad) {
  rotation = (common::expSO3(error_rad) * rotation).normalized();
}

}  // namespace

int FilterState::cloneAt(common::Time time) const {
  for (int i = 0; i < clone_count; ++i)
    if (clones[static_cast<std::size_t>(i)].stamp == time) return i;
  return -1;
}

int FilterState::oldestClone(OdometrySource source) const {
  for (int i = 0; i < clone_count; ++i)
    if (clones[static_cast<std::size_t>(i)].source == source) return i;
  return -1;
}

/// Clones are in the order of their times.
void FilterState::clonePose(OdometrySource source) {
  if (cloneAt(stamp) >= 0) return;
  if (clone_count == kMaxClones) {
    const auto own = std::count_if(clones.begin(), clones.end(),
                                   [source](const ClonedPose& clone) { return clone.source == source; });
    const OdometrySource other = source == OdometrySource::kLaser ? OdometrySource::kVision : OdometrySource::kLaser;
    dropClone(oldestClone(own >= kClonesOf[static_cast<std::size_t>(source)] ? source : other));
  }
  const int n = dimension();
  clones[static_cast<std::size_t>(clone_count++)] = {
      stamp, source, {rotation_odom_body, position_odom_m}, velocity_odom_m_s, yaw_rate_odom_rad_s};
  covariance.conservativeResize(n + kCloneSize, n + kCloneSize);
  covariance.block(n, 0, 3, n) = covariance.block(kPosition, 0, 3, n);
  covariance.block(n + 3, 0, 3, n) = covariance.block(kAttitude, 0, 3, n);
  covariance.block(0, n, n + kCloneSize, 3) = covariance.block(0, kPosition, n + kCloneSize, 3);
  covariance.block(0, n + 3, n + kCloneSize, 3) = covariance.block(0, kAttitude, n + kCloneSize, 3);
  by_laser.conservativeResize(n + kCloneSize, kLaserSize);
  by_laser.middleRows<3>(n) = by_laser.middleRows<3>(kPosition);
  by_laser.middleRows<3>(n + 3) = by_laser.middleRows<3>(kAttitude);
}

void FilterState::dropClone(int index) {
  SWIFTLET_CHECK(index >= 0 && index < clone_count, index, clone_count);
  const int n = dimension(), at = kCore + kCloneSize * index, after = n - at - kCloneSize;
  const ErrorCovariance old = covariance;
  covariance.resize(n - kCloneSize, n - kCloneSize);
  covariance.topLeftCorner(at, at) = old.topLeftCorner(at, at);
  covariance.block(at, 0, after, at) = old.block(at + kCloneSize, 0, after, at);
  covariance.block(0, at, at, after) = old.block(0, at + kCloneSize, at, after);
  covariance.block(at, at, after, after) = old.block(at + kCloneSize, at + kCloneSize, after, after);
  const LaserSensitivity old_by_laser = by_laser;
  by_laser.resize(n - kCloneSize, kLaserSize);
  by_laser.topRows(at) = old_by_laser.topRows(at);
  by_laser.bottomRows(after) = old_by_laser.bottomRows(after);
  const auto dropped = clones.begin() + index;
  std::copy(dropped + 1, clones.begin() + clone_count, dropped);
  --clone_count;
}

void FilterState::inject(const ErrorVector& error) {
  SWIFTLET_CHECK(error.size() == dimension(), error.size(), dimension());
  position_odom_m += error.segment<3>(kPosition);
  velocity_odom_m_s += error.segment<3>(kVelocity);
  rotateBy(rotation_odom_body, error.segment<3>(kAttitude));
  accelerometer_bias_m_s2 += error.segment<3>(kAccelerometerBias);
  gyroscope_bias_rad_s += error.segment<3>(kGyroscopeBias);
  drag_1_s += error(kDrag);
  wind_odom_m_s += error.segment<2>(kWind);
  ahrs_yaw_off += error.segment<2>(kAhrsOffset);
  ahrs_yaw_off.x() = common::wrapAngle(ahrs_yaw_off.x());
  for (int i = 0; i < clone_count; ++i) {
    common::Pose3& pose = clones[static_cast<std::size_t>(i)].T_odom_body;
    pose.position_m += error.segment<3>(kCore + kCloneSize * i);
    rotateBy(pose.rotation, error.segment<3>(kCore + kCloneSize * i + 3));
  }
}

bool FilterState::finite() const {
  return position_odom_m.allFinite() && velocity_odom_m_s.allFinite() && rotation_odom_body.coeffs().allFinite() &&
         accelerometer_bias_m_s2.allFinite() && gyroscope_bias_rad_s.allFinite() && std::isfinite(drag_1_s) &&
         wind_odom_m_s.allFinite() && ahrs_yaw_off.allFinite() &&
         std::isfinite(covariance.sum());  // sum() is vectorized, allFinite() is not.
}

}  // namespace swiftlet::perception::fusion
