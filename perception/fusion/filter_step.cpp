#include "perception/fusion/filter_step.hpp"

#include <algorithm>
#include <cmath>

#include "common/first_order_lag.hpp"
#include "common/square.hpp"

namespace swiftlet::perception::fusion {

using common::kRadPerDeg;
using common::square;
using common::Time;

namespace {

/// Noise density of a rate of rotation that the setpoints predict: 2 deg after a tenth of a second.
constexpr double kPredictedRateNoise_rad_s_rthz = 0.1;
/// Standard deviation of a roll or pitch that the setpoints predict, each time that attitudes are used.
constexpr double kPredictedTiltSigma_deg = 5.0;
/// Random walk of the drag, which changes with speed, battery and height.
constexpr double kDragWalk_1_s_rts = 0.002;
/// Random walk of each component of the wind.
constexpr double kWindWalk_m_s_rts = 0.001;
/// Noise of a yaw of the AHRS, and the random walk of its error beside the drift (docs/decisions/fusion.md#113).
constexpr double kAhrsYawSigma_deg = 0.2, kAhrsYawWalk_deg_rts = 0.05;
/// Standard deviation of the specific force from gravity, by the vehicle's own acceleration.
constexpr double kGravitySigma_m_s2 = 1.0;
/// A specific force whose size differs from gravity by more is not taken for it (docs/decisions/fusion.md#075).
constexpr double kGravityGate_m_s2 = 0.5;
/// Standard deviation of the zero rotation measured at rest.
constexpr double kZeroRotationSigma_rad_s = 0.01;
/// Measurements farther off than this many standard deviations, for each degree of freedom, are outliers.
constexpr double kGateSigma = 4.0;
/// The gate of heights, or of a camera's poses, that was closed for this long is opened by force
/// (docs/decisions/fusion.md#091).
constexpr double kRecovery_s = 0.4;
/// A gate of the laser's relative poses that was closed for this long is opened by force; until then inertia is used
/// alone, which a slope ahead does not mislead (measured: docs/decisions/fusion.md#091).
constexpr double kPoseRecovery_s = 1.5;
/// More forced openings than this within FusionConfig::recovery_window_s are a divergence.
constexpr int kMaxRecoveries = 3;
/// A faster estimate is a divergence.
constexpr double kMaxSpeed_m_s = 8.0;
/// Standard deviation of the velocity beyond which the filter has diverged.
constexpr double kDivergedVelocitySigma_m_s = 3.0;

/// Beyond this Mahalanobis distance the AHRS is trusted more than the filter.
constexpr double kAhrsGate = 3.0;
/// A tilt that has left that of the AHRS over so many of its updates was turned by a gyroscope whose bias has jumped.
/// In one it was a knock, over more the error of the AHRS may have changed.
constexpr double kFewestUpdates = 1.5, kMostUpdates = 10.5;
/// The vehicle's own acceleration, the difference between force and gravity, lasts for about this long: the time scale
/// of the attitude loop and of the position loop of a small quadrotor.
constexpr double kOwnAcceleration_s = 0.5;
/// Across a longer gap between samples the specific force is unknown.
constexpr double kLongestDragStep_s = 0.05;
/// The mean of what drag measurements were off by fades with this time: three times the push of a hand.
constexpr double kDragExcess_s = 0.3;
/// Of a single measurement no more than so many standard deviations count in it, so that a push hardly does.
constexpr double kDragOutlier = 2.0;

/// The greatest squared Mahalanobis distance of K degrees of freedom with about the tail probability of `kGateSigma` in
/// one. With 3 sigma it is 14.0 for three and 21.5 for six; the quantiles of chi-squared are 14.2 and 20.1.
template <int K>
double gateLimit2(double gate_sigma) {
  return square(gate_sigma) + 2.5 * (K - 1);
}

// The widen functions are for measurements that have disagreed for `recovery_s`. That is too long for outliers: the
// estimate is wrong by about the residual.

void widenHeight(FilterState& state, const Eigen::Matrix<double, 1, 1>& residual_m, double recovery_s) {
  const double jump2 = residual_m.squaredNorm();
  auto diagonal = state.covariance.diagonal();
  diagonal(kPosition + 2) += jump2;
  diagonal(kVelocity + 2) += jump2 / square(recovery_s);
}

/// `off` is by how much the pose (x_m, y_m, yaw_rad) disagrees.
void widenPlanarPose(FilterState& state, const Eigen::Vector3d& off, double recovery_s, double gravity_m_s2) {
  const double jump2 = off.head<2>().squaredNorm();
  auto diagonal = state.covariance.diagonal();
  diagonal.segment<2>(kPosition).array() += jump2;
  diagonal.segment<2>(kVelocity).array() += jump2 / square(recovery_s);
  diagonal(kAttitude + 2) += square(off.z());
  // The usual cause of a wrong velocity is a wrong roll or pitch.
  diagonal.segment<2>(kAttitude).array() += jump2 / square(square(recovery_s) * gravity_m_s2);
}

void widenSpatialPose(FilterState& state, const Eigen::Matrix<double, 6, 1>& residual, double recovery_s) {
  const double jump2 = residual.head<3>().squaredNorm(), turn2 = residual.tail<3>().squaredNorm();
  auto diagonal = state.covariance.diagonal();
  diagonal.segment<3>(kPosition).array() += jump2;
  diagonal.segment<3>(kVelocity).array() += jump2 / square(recovery_s);
  diagonal.segment<3>(kAttitude).array() += turn2;
}

/// An accelerometer whose bias has jumped by `jump_m_s2` since about `since_s` ago has misled the velocity, too.
void widenAccelerometer(FilterState& state, double jump_m_s2, double since_s) {
  auto diagonal = state.covariance.diagonal();
  diagonal.segment<2>(kAccelerometerBias).array() += square(jump_m_s2);
  diagonal.segment<2>(kVelocity).array() += square(jump_m_s2 * since_s);
  diagonal.segment<2>(kPosition).array() += square(0.5 * jump_m_s2 * square(since_s));
}

/// A gyroscope whose bias has jumped has turned the tilt to where it is off by `off`, by `slipped` of it in `since_s`
/// (both as upDirection() measures them): one cause, so that the tilt and the bias are off together.
void widenGyroscope(FilterState& state, const Eigen::Vector2d& off, const Eigen::Vector2d& slipped, double since_s) {
  const auto tilt = [](const Eigen::Vector2d& up) { return Eigen::Vector3d(up.y(), -up.x(), 0.0); };
  const Eigen::Vector3d rate_rad_s = tilt(slipped) / since_s;
  Eigen::Matrix<double, kCore, 1> cause = Eigen::Matrix<double, kCore, 1>::Zero();
  cause.segment<3>(kAttitude) = tilt(off);
  cause.segment<3>(kGyroscopeBias) = -(state.rotation_odom_body.conjugate() * rate_rad_s);
  state.covariance.topLeftCorner<kCore, kCore>() += cause * cause.transpose();
  // Of the yaw, which no tilt shows.
  state.covariance(kGyroscopeBias + 2, kGyroscopeBias + 2) += rate_rad_s.squaredNorm();
}

void recover(FilterState& state) {
  Recoveries& r = state.recoveries;
  const bool recent = r.recent > 0 && (state.stamp - r.last).seconds() < FusionConfig::recovery_window_s;
  r = {r.all + 1, recent ? r.recent + 1 : 1, state.stamp};
  if (r.recent > kMaxRecoveries) state.diverged = true;
}

void watch(FilterState& state) {
  const double velocity_variance = state.covariance.diagonal().segment<3>(kVelocity).maxCoeff();
  const bool sane = state.finite() && state.velocity_odom_m_s.norm() < kMaxSpeed_m_s &&
                    velocity_variance < square(kDivergedVelocitySigma_m_s) &&
                    state.covariance.diagonal().minCoeff() >= 0.0;
  if (!sane) state.diverged = true;
}

}  // namespace

FilterStep::FilterStep(const FusionConfig& config)
    : config_(config),
      noise_{config.accelerometer_noise_m_s2_rthz,
             config.gyroscope_noise_rad_s_rthz,
             config.accelerometer_bias_walk_m_s3_rthz,
             config.gyroscope_bias_walk_rad_s2_rthz,
             kDragWalk_1_s_rts,
             kWindWalk_m_s_rts,
             kAhrsYawWalk_deg_rts * kRadPerDeg,
             config.gravity_m_s2} {}

void FilterStep::advance(const Slot& before, std::span<const Measurement> measured, Slot& now) const {
  FilterState& state = now.state;
  state = before.state;
  // A sample is the mean over the time since the one before it. Taken as the value at its end, and averaged with the
  // one before, it would be late by half a period, and so would the attitude be.
  ImuValue at = now.imu;
  at.stamp = before.imu.stamp;
  ImuNoise noise = noise_;
  noise.accelerometer_m_s2_rthz = accelerometerNoise_m_s2_rthz(now);
  if (now.predicted) noise.gyroscope_rad_s_rthz = kPredictedRateNoise_rad_s_rthz;
  const auto advanceTo = [&](Time time) {
    if (time <= at.stamp) return;
    ImuValue next = now.imu;
    next.stamp = time;
    propagate(state, at, next, noise);
    at = next;
  };
  for (const Measurement& measurement : measured) {
    advanceTo(measurement.stamp);
    apply(state, measurement);
  }
  advanceTo(now.imu.stamp);
  if (usesDrag()) accumulateDrag(state, before, now);
  applySlot(state, now);
  // Restores the symmetry that rounding errors destroy over many steps.
  state.covariance.triangularView<Eigen::StrictlyUpper>() = state.covariance.transpose();
  watch(state);
}

double FilterStep::accelerometerNoise_m_s2_rthz(const Slot& slot) const {
  constexpr double kPredicted_m_s2_rthz = 0.5;  // Of the force that the thrust predicts: 5 % of gravity for a second.
  return slot.predicted ? kPredicted_m_s2_rthz
                        : std::max(noise_.accelerometer_m_s2_rthz, slot.accelerometer_noise_m_s2_rthz);
}

void FilterStep::apply(FilterState& state, const Measurement& m) const {
  switch (m.kind) {
    case MeasurementKind::kClone:
      state.clonePose(m.source);
      return;
    case MeasurementKind::kHeight:
      gatedUpdate(state, state.height_gate, height(state, m.value, m.covariance(0, 0)), kRecovery_s, widenHeight);
      return;
    case MeasurementKind::kVertical:
      if (replaceVertical(state, m.vertical, m.covariance)) state.height_gate.last_accepted = state.stamp;
      return;
    case MeasurementKind::kAbsolutePose:
      update(state, absolutePose(state, m.pose, m.covariance));
      return;
    case MeasurementKind::kRelativePose:
    case MeasurementKind::kRelativePose3:
      updateByRelativePose(state, m);
      return;
  }
}

void FilterStep::updateByRelativePose(FilterState& state, const Measurement& m) const {
  const int clone = state.cloneAt(m.from);
  if (clone < 0) return;  // The clone was dropped after the measurement was accepted.
  if (m.kind == MeasurementKind::kRelativePose3) {
    // A pose in space never overrules the laser: its gate is forced only where nothing else measures the position.
    const bool alone = (state.stamp - state.relative_gate.last_accepted).seconds() >= kRecovery_s;
    gatedUpdate(state, state.spatial_gate, relativePose3(state, clone, m.pose3, m.covariance6), kRecovery_s,
                widenSpatialPose, alone);
    return;
  }
  const Linearized<3> whole = relativePose(state, clone, m.pose, m.covariance);
  doubtAccelerometer(state, whole);
  if (!m.unobservable_motion)
    return gatedUpdate(state, state.relative_gate, whole, kPoseRecovery_s,
                       [this](FilterState& s, const Eigen::Vector3d& off, double recovery_s) {
                         widenPlanarPose(s, off, recovery_s, config_.gravity_m_s2);
                       });
  gatedUpdate(
      state, state.relative_gate, relativePoseAcross(state, clone, m.pose, m.covariance, *m.unobservable_motion),
      kPoseRecovery_s, [&](FilterState& s, const Eigen::Vector2d& across_m, double recovery_s) {
        widenPlanarPose(s, common::changeAcross(*m.unobservable_motion, across_m), recovery_s, config_.gravity_m_s2);
      });
}

/// Where the laser and the drag both contradict the accelerometer, its bias has jumped.
void FilterStep::doubtAccelerometer(FilterState& state, const Linearized<3>& pose) const {
  const double jump_m_s2 = state.drag_excess_m_s2.norm();
  const double sigma_m_s2 = config_.drag_noise_m_s2_rthz / std::sqrt(2.0 * kDragExcess_s);
  if (jump_m_s2 < kGateSigma * sigma_m_s2 || mahalanobis2(state, pose) <= gateLimit2<3>(kGateSigma)) return;
  widenAccelerometer(state, jump_m_s2, kDragExcess_s);
  state.drag_excess_m_s2.setZero();
}

void FilterStep::applySlot(FilterState& state, const Slot& s) const {
  if (!s.attitude_due) return;
  if (s.predicted) {
    update(state, upDirection(state, s.up_body, square(kPredictedTiltSigma_deg * kRadPerDeg)));
  } else if (config_.use_ahrs) {
    updateByAhrs(state, s.up_body);
    updateByAhrsYaw(state, s.ahrs_yaw_rad);
  }
  if (config_.use_gravity && !s.predicted)
    updateByGravity(state, s);
  else if (usesDrag())
    updateByDrag(state, s.accelerometer_noise_m_s2_rthz);
  if (s.at_rest) {
    update(state, zeroVelocity(state, square(config_.zero_velocity_sigma_m_s)));
    update(state, zeroRotation(state, s.imu.angular_velocity_body_rad_s, square(kZeroRotationSigma_rad_s)));
    state.relative_gate.last_accepted = s.imu.stamp;
  }
}

void FilterStep::updateByAhrs(FilterState& state, const Eigen::Vector3d& up_body) const {
  const double variance = square(config_.ahrs_sigma_deg * kRadPerDeg);
  Linearized<2> m = upDirection(state, up_body, variance);
  const double off2 = mahalanobis2(state, m);
  if (off2 > square(kAhrsGate)) {
    // An AHRS is hardly ever wrong by that much, so the filter's attitude is wrong, and with it a bias.
    const double since_s = (state.stamp - state.tilt_by_ahrs.at).seconds();
    const double updates = since_s * config_.attitude_rate_hz;
    if (updates > kFewestUpdates && updates < kMostUpdates) {
      widenGyroscope(state, m.residual, m.residual - state.tilt_by_ahrs.off, since_s);
    } else {
      // A wrong attitude moves a part of gravity into the horizontal axes and takes almost nothing from the vertical
      // one.
      const double slipped2 = m.residual.squaredNorm();
      auto diagonal = state.covariance.diagonal();
      diagonal.segment<2>(kAttitude).array() += slipped2;
      diagonal.segment<2>(kAccelerometerBias).array() += square(config_.gravity_m_s2) * slipped2;
    }
  } else {
    if (off2 <= 2.0) state.tilt_by_ahrs = {state.stamp, m.residual};  // Their mean.
    // N samples whose error has the correlation time tau contain as much information as samples of white noise of this
    // variance (integral of the autocorrelation).
    m.noise *= 1.0 + 2.0 * config_.ahrs_correlation_s * config_.attitude_rate_hz;
  }
  update(state, m);
}

/// An AHRS keeps its heading far longer than gyroscopes whose bias walks, but for a slow drift, which the laser shows
/// where it sees the heading. A yaw that jumps has a new offset.
void FilterStep::updateByAhrsYaw(FilterState& state, double yaw_rad) const {
  const Linearized<1> m = ahrsYaw(state, yaw_rad, square(kAhrsYawSigma_deg * kRadPerDeg));
  if (mahalanobis2(state, m) > square(kGateSigma)) {
    state.covariance.row(kAhrsOffset).setZero();
    state.covariance.col(kAhrsOffset).setZero();
    state.by_laser.row(kAhrsOffset).setZero();
    state.covariance(kAhrsOffset, kAhrsOffset) = square(kUnknownYaw_rad);
  }
  update(state, m);
}

/// A force of another size than gravity accelerates the vehicle. One of the same size may, too: its direction counts as
/// that of gravity only in the mean over the vehicle's own motion, so that its noise is that of a slow process.
void FilterStep::updateByGravity(FilterState& state, const Slot& s) const {
  const Eigen::Vector3d force_m_s2 = s.imu.specific_force_body_m_s2;
  const double excess_m_s2 = (force_m_s2 - state.accelerometer_bias_m_s2).norm() - config_.gravity_m_s2;
  if (std::abs(excess_m_s2) > kGravityGate_m_s2) return;
  const double slow = s.at_rest ? 1.0 : 1.0 + 2.0 * kOwnAcceleration_s * config_.attitude_rate_hz;
  const Linearized<3> m = gravity(state, force_m_s2, config_.gravity_m_s2, slow * square(kGravitySigma_m_s2));
  if (mahalanobis2(state, m) <= gateLimit2<3>(kGateSigma)) update(state, m);
}

/// The ground also pushes a standing vehicle, so nothing is learned about drag at rest.
void FilterStep::accumulateDrag(FilterState& state, const Slot& before, const Slot& now) const {
  DragStretch& stretch = state.drag_stretch;
  const double dt_s = (now.imu.stamp - before.imu.stamp).seconds();
  if (now.at_rest || now.predicted || dt_s > kLongestDragStep_s) {
    stretch = {};
    return;
  }
  stretch.seconds += dt_s;
  stretch.force_sum_m_s +=
      0.5 * dt_s * (before.imu.specific_force_body_m_s2 + now.imu.specific_force_body_m_s2).head<2>();
  stretch.velocity_sum_m += dt_s * (state.rotation_odom_body.conjugate() * state.velocity_odom_m_s).head<2>();
}

/// If the vehicle is pushed or touches something, the force is not only drag: such measurements are rejected by the
/// gate.
void FilterStep::updateByDrag(FilterState& state, double accelerometer_noise_m_s2_rthz) const {
  if (state.drag_stretch.seconds <= 0.0) return;
  const double noise_m_s2_rthz = std::max(config_.drag_noise_m_s2_rthz, accelerometer_noise_m_s2_rthz);
  const double sigma_m_s2 = noise_m_s2_rthz / std::sqrt(state.drag_stretch.seconds);
  const Linearized<2> m = drag(state, square(sigma_m_s2));
  const Eigen::Vector2d off_m_s2 = m.residual.cwiseMax(-kDragOutlier * sigma_m_s2).cwiseMin(kDragOutlier * sigma_m_s2);
  state.drag_excess_m_s2 +=
      common::followedShare(state.drag_stretch.seconds, kDragExcess_s) * (off_m_s2 - state.drag_excess_m_s2);
  if (mahalanobis2(state, m) <= square(kGateSigma)) update(state, m);
  state.drag_stretch = {};
}

template <int K, typename Widen>
void FilterStep::gatedUpdate(FilterState& state, GateMemory& gate, const Linearized<K>& m, double recovery_s,
                             Widen widen, bool may_force) const {
  const double innovation2 = mahalanobis2(state, m);
  gate.innovations.sum += innovation2;
  gate.innovations.degrees += static_cast<std::uint64_t>(K);
  if (innovation2 > gateLimit2<K>(kGateSigma)) {
    if (!gate.closed) {
      gate.closed = true;
      gate.closed_since = state.stamp;
    }
    ++gate.rejected;
    if (!may_force || (state.stamp - gate.closed_since).seconds() < recovery_s) return;
    widen(state, m.residual, recovery_s);
    recover(state);
  }
  if (!update(state, m)) return;
  gate.closed = false;
  gate.last_accepted = state.stamp;
}

}  // namespace swiftlet::perception::fusion
