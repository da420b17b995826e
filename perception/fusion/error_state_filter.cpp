// The history and its replay; the mathematics is in imu_model and measurement_models.
#include "perception/fusion/error_state_filter.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <Eigen/Eigenvalues>

#include "common/check.hpp"
#include "common/square.hpp"
#include "common/validation.hpp"
#include "perception/fusion/filter_state.hpp"
#include "perception/fusion/imu_model.hpp"
#include "perception/fusion/measurement_history.hpp"
#include "perception/fusion/measurement_models.hpp"
#include "perception/fusion/rest_estimator.hpp"

namespace swiftlet::perception {

using namespace fusion;
using common::Duration;
using common::kRadPerDeg;
using common::square;
using common::Time;

namespace {

constexpr double kMaxExtrapolation_s = 0.02;
constexpr double kMaxAhead_s = 0.5;
/// IMU samples a second that the history has room for; a faster IMU shortens it.
constexpr double kRingRate_hz = 256.0;
constexpr double kUnitTolerance = 1e-3;  // NaN is beyond it.
constexpr std::size_t kMeasurementCapacity = 1024;
/// Standard deviations that an AHRS may be off before it is believed more than the filter.
constexpr double kAhrsGate = 3.0;
/// What was felt between two samples is not known over more than this.
constexpr double kLongestDragStep_s = 0.05;

/// One IMU sample and the state after everything measured up to it.
struct Slot {
  ImuValue imu;
  Eigen::Vector3d up_body = Eigen::Vector3d::UnitZ();  ///< By the AHRS.
  bool attitude_due = false;
  bool at_rest = false;
  FilterState state;
};

bool isCovariance(const Eigen::Matrix3d& m) {
  if (!m.allFinite() || !m.isApprox(m.transpose(), 1e-6)) return false;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() > 0.0;
}

}  // namespace

const char* toString(FusionStatus status) {
  switch (status) {
    case FusionStatus::kNotInitialized:
      return "not initialized";
    case FusionStatus::kOk:
      return "ok";
    case FusionStatus::kDegraded:
      return "degraded";
    case FusionStatus::kDiverged:
      return "diverged";
  }
  return "";
}

struct ErrorStateFilter::Impl {
  explicit Impl(const Config& c);

  // History.
  Slot& slot(std::size_t age_from_oldest) { return ring[(oldest + age_from_oldest) % ring.size()]; }
  const Slot& newest() { return slot(count - 1); }
  void push(const common::ImuSample& sample);
  Insertion insert(const Measurement& measurement);
  Insertion insertVertical(MeasurementKind kind, Time time, double value, double variance, double common_variance_m2);
  void replay() { replay(count); }
  /// Brings the first `until` slots up to date. Measurements of one scan come one after the other, at one instant: what
  /// is later is computed once, after the last of them.
  void replay(std::size_t until);
  void step(const Slot& before, Slot& now);

  // One state.
  void apply(FilterState& state, const Measurement& measurement) const;
  void applySlot(FilterState& state, const Slot& s) const;
  void updateByAhrs(FilterState& state, const Eigen::Vector3d& up_body) const;
  void feelDrag(FilterState& state, const Slot& before, const Slot& now) const;
  void updateByDrag(FilterState& state) const;
  template <int K>
  void gatedUpdate(FilterState& state, GateMemory& gate, const Linearized<K>& measurement) const;
  void recover(FilterState& state) const;
  void watch(FilterState& state) const;
  bool horizontalFresh(const FilterState& state, bool at_rest) const;

  Config config;
  ImuNoise noise;
  std::vector<Slot> ring;
  std::size_t oldest = 0, count = 0;
  MeasurementHistory measurements{kMeasurementCapacity};
  std::size_t dirty_from = 0;  ///< First slot (from the oldest) whose state must be computed again; count: none.
  Time last_attitude;
  bool at_rest = false;
  bool diverged = false;
  RestEstimator rest;
  Time newest_seen;
  bool any_seen = false;
  FusionCounts counters;
};

ErrorStateFilter::Impl::Impl(const Config& c)
    : config(c),
      noise{c.accelerometer_noise_m_s2_rthz,
            c.gyroscope_noise_rad_s_rthz,
            c.accelerometer_bias_walk_m_s3_rthz,
            c.gyroscope_bias_walk_rad_s2_rthz,
            c.drag_walk_1_s_rts,
            c.wind_walk_m_s_rts,
            c.gravity_m_s2},
      ring(static_cast<std::size_t>(std::ceil(c.history_s * kRingRate_hz)) + 2),
      rest({c.rest_s, c.rest_gyroscope_sigma_rad_s, c.rest_accelerometer_sigma_m_s2, c.gravity_m_s2}) {}

void ErrorStateFilter::Impl::push(const common::ImuSample& sample) {
  const Time now = sample.stamps.measured;
  if (count == ring.size()) {
    SWIFTLET_CHECK(dirty_from > 0, dirty_from);
    oldest = (oldest + 1) % ring.size();
    --count;
    --dirty_from;
  }
  // Too old by the configured length also when the ring has room: how late is late must not depend on the IMU's rate.
  while (count > 2 && now - slot(1).imu.stamp > Duration::fromSeconds(config.history_s) && dirty_from > 1) {
    oldest = (oldest + 1) % ring.size();
    --count;
    --dirty_from;
  }
  measurements.dropUntil(slot(0).imu.stamp);
  Slot& s = slot(count);
  s.imu = {now, sample.angular_velocity_body_rad_s, sample.specific_force_body_m_s2};
  s.at_rest = at_rest;
  s.up_body = sample.rotation_ahrs_body.conjugate() * Eigen::Vector3d::UnitZ();
  s.attitude_due = (now - last_attitude).seconds() >= 1.0 / config.attitude_rate_hz - 1e-6;
  if (s.attitude_due) last_attitude = now;
  dirty_from = std::min(dirty_from, count);
  ++count;
}

Insertion ErrorStateFilter::Impl::insert(const Measurement& measurement) {
  const auto refuse = [this](Insertion why) {
    ++counters.refused;
    return why;
  };
  if (count == 0 || measurement.stamp <= slot(0).imu.stamp) return refuse(Insertion::kTooOld);
  if ((measurement.stamp - newest().imu.stamp).seconds() > kMaxAhead_s) return refuse(Insertion::kTooNew);
  if (!measurements.insert(measurement)) return refuse(Insertion::kTooOld);
  ++counters.measurements;
  std::size_t first = count;
  while (first > 1 && slot(first - 1).imu.stamp >= measurement.stamp) --first;
  dirty_from = std::min(dirty_from, first);
  return Insertion::kTaken;
}

void ErrorStateFilter::Impl::replay(std::size_t until) {
  if (dirty_from >= until) return;
  SWIFTLET_CHECK(dirty_from > 0, until);
  counters.replays += std::min(until, count - 1) - dirty_from;
  for (std::size_t i = dirty_from; i < until; ++i) step(slot(i - 1), slot(i));
  dirty_from = until;
  diverged = diverged || slot(until - 1).state.diverged;
}

void ErrorStateFilter::Impl::step(const Slot& before, Slot& now) {
  FilterState& state = now.state;
  state = before.state;
  ImuValue at = before.imu;
  const auto advanceTo = [&](Time time) {
    if (time <= at.stamp) return;
    const ImuValue next = interpolate(before.imu, now.imu, time);
    propagate(state, at, next, noise);
    at = next;
  };
  for (const Measurement& measurement : measurements.within(before.imu.stamp, now.imu.stamp)) {
    advanceTo(measurement.stamp);
    apply(state, measurement);
  }
  advanceTo(now.imu.stamp);
  if (config.use_drag) feelDrag(state, before, now);
  applySlot(state, now);
  // Rounding makes the two halves drift apart over many steps.
  state.covariance.triangularView<Eigen::StrictlyUpper>() = state.covariance.transpose();
  watch(state);
}

void ErrorStateFilter::Impl::apply(FilterState& state, const Measurement& m) const {
  switch (m.kind) {
    case MeasurementKind::kClone:
      state.clonePose();
      return;
    case MeasurementKind::kHeight:
      state.height_common_variance_m2 = m.common_variance_m2;
      gatedUpdate(state, state.height_gate, height(state, m.value, m.covariance(0, 0)));
      return;
    case MeasurementKind::kVerticalSpeed:
      update(state, verticalSpeed(state, m.value, m.covariance(0, 0)));
      return;
    case MeasurementKind::kAbsolutePose:
      update(state, absolutePose(state, m.pose, m.covariance));
      return;
    case MeasurementKind::kRelativePose: {
      const int clone = state.cloneAt(m.from);
      if (clone < 0) return;  // Dropped for newer ones since it was accepted.
      state.clones[static_cast<std::size_t>(clone)].last_used = m.stamp;
      if (m.unseen_direction)
        gatedUpdate(state, state.relative_gate,
                    relativePoseAcross(state, clone, m.pose, m.covariance, *m.unseen_direction));
      else
        gatedUpdate(state, state.relative_gate, relativePose(state, clone, m.pose, m.covariance));
      return;
    }
  }
}

void ErrorStateFilter::Impl::applySlot(FilterState& state, const Slot& s) const {
  if (!s.attitude_due) return;
  if (config.use_ahrs) updateByAhrs(state, s.up_body);
  if (config.use_drag) updateByDrag(state);
  if (config.use_gravity) {
    update(state,
           gravity(state, s.imu.specific_force_body_m_s2, config.gravity_m_s2, square(config.gravity_sigma_m_s2)));
  }
  if (s.at_rest) {
    update(state, zeroVelocity(state, square(config.zero_velocity_sigma_m_s)));
    update(state, zeroRotation(state, s.imu.angular_velocity_body_rad_s, square(config.zero_rotation_sigma_rad_s)));
    state.relative_gate.last_accepted = s.imu.stamp;
  }
}

void ErrorStateFilter::Impl::updateByAhrs(FilterState& state, const Eigen::Vector3d& up_body) const {
  const double variance = square(config.ahrs_sigma_deg * kRadPerDeg);
  Linearized<2> m = upDirection(state, up_body, variance);
  if (mahalanobis2(state, m) > square(kAhrsGate)) {
    // The AHRS does not err that far: the filter's own horizon has slipped, and with it what it takes for bias: a wrong
    // horizon moves gravity into the horizontal axes, and takes next to nothing from the vertical one.
    const double slipped2 = m.residual.squaredNorm();
    auto diagonal = state.covariance.diagonal();
    diagonal.segment<2>(kAttitude).array() += slipped2;
    diagonal.segment<2>(kAccelerometerBias).array() += square(config.gravity_m_s2) * slipped2;
  } else {
    // N samples of an error that keeps for tau are worth as much as white ones of this variance (integral of the
    // autocorrelation).
    m.noise *= 1.0 + 2.0 * config.ahrs_correlation_s * config.attitude_rate_hz;
  }
  update(state, m);
}

/// The ground, too, pushes a vehicle that stands; then nothing is learned of the air.
void ErrorStateFilter::Impl::feelDrag(FilterState& state, const Slot& before, const Slot& now) const {
  DragStretch& stretch = state.drag_stretch;
  const double dt_s = (now.imu.stamp - before.imu.stamp).seconds();
  if (now.at_rest || dt_s > kLongestDragStep_s) {
    stretch = {};
    return;
  }
  stretch.seconds += dt_s;
  stretch.force_sum_m_s +=
      0.5 * dt_s * (before.imu.specific_force_body_m_s2 + now.imu.specific_force_body_m_s2).head<2>();
  stretch.velocity_sum_m += dt_s * (state.rotation_odom_body.conjugate() * state.velocity_odom_m_s).head<2>();
}

/// Who is pushed or touches something feels more than the air: that is left out.
void ErrorStateFilter::Impl::updateByDrag(FilterState& state) const {
  if (state.drag_stretch.seconds <= 0.0) return;
  const Linearized<2> m = drag(state, square(config.drag_noise_m_s2_rthz) / state.drag_stretch.seconds);
  if (mahalanobis2(state, m) <= square(config.gate_sigma)) update(state, m);
  state.drag_stretch = {};
}

template <int K>
void ErrorStateFilter::Impl::gatedUpdate(FilterState& state, GateMemory& gate, const Linearized<K>& m) const {
  const double limit2 = square(config.gate_sigma) + 2.5 * (K - 1);  // About the same tail for K degrees of freedom.
  if (mahalanobis2(state, m) > limit2) {
    if (!gate.closed) {
      gate.closed = true;
      gate.closed_since = state.stamp;
    }
    ++gate.rejected;
    if ((state.stamp - gate.closed_since).seconds() < config.recovery_s) return;
    // The measurement has disagreed for too long to be an outlier: the estimate is wrong, by about the residual.
    const double jump2 = m.residual.template head<std::max(1, K - 1)>().squaredNorm();
    auto diagonal = state.covariance.diagonal();
    if constexpr (K == 1) {
      diagonal(kPosition + 2) += jump2;
      diagonal(kVelocity + 2) += jump2 / square(config.recovery_s);
    } else {
      diagonal.segment<2>(kPosition).array() += jump2;
      diagonal.segment<2>(kVelocity).array() += jump2 / square(config.recovery_s);
      diagonal(kAttitude + 2) += square(m.residual(K - 1));
      // What carried the velocity away is most often a slipped horizon.
      diagonal.segment<2>(kAttitude).array() += jump2 / square(square(config.recovery_s) * config.gravity_m_s2);
    }
    recover(state);
  }
  if (!update(state, m)) return;
  gate.closed = false;
  gate.last_accepted = state.stamp;
}

void ErrorStateFilter::Impl::recover(FilterState& state) const {
  const bool recent =
      state.recent_recoveries > 0 && (state.stamp - state.last_recovery).seconds() < config.recovery_window_s;
  state.recent_recoveries = recent ? state.recent_recoveries + 1 : 1;
  state.last_recovery = state.stamp;
  ++state.recoveries;
  if (state.recent_recoveries > config.max_recoveries) state.diverged = true;
}

void ErrorStateFilter::Impl::watch(FilterState& state) const {
  const double velocity_variance = state.covariance.diagonal().segment<3>(kVelocity).maxCoeff();
  const bool sane = state.finite() && state.velocity_odom_m_s.norm() < config.max_speed_m_s &&
                    velocity_variance < square(config.diverged_velocity_sigma_m_s) &&
                    state.covariance.diagonal().minCoeff() >= 0.0;
  if (!sane) state.diverged = true;
}

bool ErrorStateFilter::Impl::horizontalFresh(const FilterState& state, bool rests) const {
  return rests || (state.stamp - state.relative_gate.last_accepted).seconds() <= config.horizontal_timeout_s;
}

ErrorStateFilter::ErrorStateFilter(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
ErrorStateFilter::~ErrorStateFilter() = default;
ErrorStateFilter::ErrorStateFilter(ErrorStateFilter&&) noexcept = default;
ErrorStateFilter& ErrorStateFilter::operator=(ErrorStateFilter&&) noexcept = default;

void ErrorStateFilter::predict(const common::ImuSample& sample) {
  Impl& f = *impl_;
  const Time now = sample.stamps.measured;
  const bool usable = sample.angular_velocity_body_rad_s.allFinite() && sample.specific_force_body_m_s2.allFinite() &&
                      std::abs(sample.rotation_ahrs_body.norm() - 1.0) < 0.01 && (!f.any_seen || now > f.newest_seen);
  if (!usable) {
    ++f.counters.imu_dropped;
    return;
  }
  f.newest_seen = now;
  f.any_seen = true;
  f.rest.add(sample);
  if (f.count == 0) return;
  f.replay();  // Before the ring may lose the oldest state.
  f.push(sample);
  f.replay();
}

tl::expected<void, std::string> ErrorStateFilter::initialize(double height_m) {
  Impl& f = *impl_;
  if (!std::isfinite(height_m)) return tl::unexpected(std::string("the height at rest is not known"));
  const auto rest = f.rest.estimate();
  if (!rest) return tl::unexpected(rest.error());

  Slot first;
  first.imu = {f.newest_seen, rest->angular_velocity_body_rad_s, rest->specific_force_body_m_s2};
  FilterState& state = first.state;
  state.stamp = f.newest_seen;
  state.position_odom_m.z() = height_m;
  state.rotation_odom_body = rest->rotation_level_body;
  state.gyroscope_bias_rad_s = rest->angular_velocity_body_rad_s;
  state.relative_gate.last_accepted = state.height_gate.last_accepted = state.stamp;

  // Position and yaw are the origin by definition. Tilt and accelerometer bias share what gravity shows: start wide and
  // let one gravity measurement correlate them.
  auto diagonal = state.covariance.diagonal();
  diagonal.segment<3>(kPosition) << 1e-8, 1e-8, square(common::kStandingHeightSigma_m);
  diagonal.segment<3>(kVelocity).setConstant(square(f.config.zero_velocity_sigma_m_s));
  diagonal.segment<3>(kAttitude) << square(0.2), square(0.2), 1e-8;
  diagonal.segment<3>(kAccelerometerBias).setConstant(square(f.config.accelerometer_bias_sigma_m_s2));
  diagonal.segment<3>(kGyroscopeBias).setConstant(square(rest->gyroscope_mean_sigma_rad_s) + 1e-8);
  state.drag_1_s = f.config.drag_1_s;
  diagonal(kDrag) = square(f.config.drag_sigma_1_s);
  diagonal.segment<2>(kWind).setConstant(square(f.config.wind_sigma_m_s));
  update(state, gravity(state, rest->specific_force_body_m_s2, f.config.gravity_m_s2,
                        square(rest->accelerometer_mean_sigma_m_s2) + 1e-6));

  f.oldest = 0;
  f.count = 1;
  f.dirty_from = 1;
  f.ring[0] = first;
  f.measurements.clear();
  f.last_attitude = state.stamp;
  f.diverged = false;
  return {};
}

bool ErrorStateFilter::initialized() const { return impl_->count > 0; }

void ErrorStateFilter::setAtRest(bool at_rest) { impl_->at_rest = at_rest; }

Insertion ErrorStateFilter::addClone(Time time) {
  Measurement m;
  m.stamp = time;
  m.kind = MeasurementKind::kClone;
  return impl_->insert(m);
}

Insertion ErrorStateFilter::addRelativePose(Time from, Time to, const common::Pose2& T_from_to,
                                            const Eigen::Matrix3d& covariance,
                                            const std::optional<Eigen::Vector2d>& unseen_direction) {
  const bool direction_valid = !unseen_direction || std::abs(unseen_direction->norm() - 1.0) < kUnitTolerance;
  if (!isFinite(T_from_to) || to <= from || !isCovariance(covariance) || !direction_valid) {
    ++impl_->counters.refused;
    return Insertion::kInvalid;
  }
  if (!hasClone(from)) {
    ++impl_->counters.refused;
    return Insertion::kUnknownReference;
  }
  Measurement m;
  m.stamp = to;
  m.kind = MeasurementKind::kRelativePose;
  m.from = from;
  m.pose = T_from_to;
  m.covariance = covariance;
  m.unseen_direction = unseen_direction;
  return impl_->insert(m);
}

Insertion ErrorStateFilter::Impl::insertVertical(MeasurementKind kind, Time time, double value, double variance,
                                                 double common_variance_m2) {
  const bool valid = std::isfinite(value) && std::isfinite(variance) && variance > 0.0 &&
                     std::isfinite(common_variance_m2) && common_variance_m2 >= 0.0;
  if (!valid) {
    ++counters.refused;
    return Insertion::kInvalid;
  }
  Measurement m;
  m.stamp = time;
  m.kind = kind;
  m.value = value;
  m.covariance(0, 0) = variance;
  m.common_variance_m2 = common_variance_m2;
  return insert(m);
}

Insertion ErrorStateFilter::addHeight(Time time, double height_m, double variance_m2, double common_variance_m2) {
  return impl_->insertVertical(MeasurementKind::kHeight, time, height_m, variance_m2, common_variance_m2);
}

Insertion ErrorStateFilter::addVerticalSpeed(Time time, double speed_m_s, double variance_m2_s2) {
  return impl_->insertVertical(MeasurementKind::kVerticalSpeed, time, speed_m_s, variance_m2_s2, 0.0);
}

Insertion ErrorStateFilter::addAbsolutePose2(Time time, const common::Pose2& T_odom_body,
                                             const Eigen::Matrix3d& covariance) {
  if (!isFinite(T_odom_body) || !isCovariance(covariance)) {
    ++impl_->counters.refused;
    return Insertion::kInvalid;
  }
  Measurement m;
  m.stamp = time;
  m.kind = MeasurementKind::kAbsolutePose;
  m.pose = T_odom_body;
  m.covariance = covariance;
  return impl_->insert(m);
}

bool ErrorStateFilter::hasClone(Time time) const {
  Impl& f = *impl_;
  if (f.count == 0) return false;
  if (f.dirty_from >= f.count && f.newest().state.cloneAt(time) >= 0) return true;
  return f.measurements.holdsClone(time) || f.newest().state.cloneAt(time) >= 0;
}

common::VehicleState ErrorStateFilter::state() const {
  Impl& f = *impl_;
  common::VehicleState out;
  if (f.count == 0) {
    out.stamp = f.newest_seen;
    return out;
  }
  f.replay();
  const Slot& newest = f.newest();
  const FilterState& s = newest.state;
  out.stamp = s.stamp;
  out.T_odom_body = {s.rotation_odom_body, s.position_odom_m};
  out.velocity_odom_m_s = s.velocity_odom_m_s;
  out.angular_velocity_body_rad_s = newest.imu.angular_velocity_body_rad_s - s.gyroscope_bias_rad_s;
  out.position_covariance_m2 = s.covariance.block<3, 3>(kPosition, kPosition);
  out.position_covariance_m2(2, 2) += s.height_common_variance_m2;
  out.velocity_covariance_m2_s2 = s.covariance.block<3, 3>(kVelocity, kVelocity);
  out.height_above_ground_m = s.position_odom_m.z();

  const auto velocity_sigma = out.velocity_covariance_m2_s2.diagonal().cwiseMax(0.0).cwiseSqrt().eval();
  const bool vertical_fresh =
      newest.at_rest || (s.stamp - s.height_gate.last_accepted).seconds() <= f.config.vertical_timeout_s;
  out.horizontal_valid = !f.diverged && f.horizontalFresh(s, newest.at_rest) &&
                         velocity_sigma.head<2>().maxCoeff() <= f.config.valid_velocity_sigma_m_s;
  out.vertical_valid = !f.diverged && vertical_fresh && velocity_sigma.z() <= f.config.valid_velocity_sigma_m_s &&
                       out.position_covariance_m2(2, 2) <= square(f.config.valid_height_sigma_m);
  return out;
}

Time ErrorStateFilter::newest() const { return impl_->newest_seen; }

Eigen::Vector3d ErrorStateFilter::accelerationOdom_m_s2() const {
  Impl& f = *impl_;
  if (f.count == 0) return Eigen::Vector3d::Zero();
  f.replay();
  const Slot& newest = f.newest();
  return newest.state.rotation_odom_body *
             (newest.imu.specific_force_body_m_s2 - newest.state.accelerometer_bias_m_s2) -
         Eigen::Vector3d(0.0, 0.0, f.config.gravity_m_s2);
}

Eigen::Vector3d ErrorStateFilter::accelerometerBias_m_s2() const {
  if (impl_->count == 0) return Eigen::Vector3d::Zero();
  impl_->replay();
  return impl_->newest().state.accelerometer_bias_m_s2;
}

Eigen::Vector3d ErrorStateFilter::gyroscopeBias_rad_s() const {
  if (impl_->count == 0) return Eigen::Vector3d::Zero();
  impl_->replay();
  return impl_->newest().state.gyroscope_bias_rad_s;
}

double ErrorStateFilter::drag_1_s() const {
  if (impl_->count == 0) return impl_->config.drag_1_s;
  impl_->replay();
  return impl_->newest().state.drag_1_s;
}

Eigen::Vector2d ErrorStateFilter::wind_odom_m_s() const {
  if (impl_->count == 0) return Eigen::Vector2d::Zero();
  impl_->replay();
  return impl_->newest().state.wind_odom_m_s;
}

Eigen::Matrix<double, 15, 15> ErrorStateFilter::covariance() const {
  if (impl_->count == 0) return Eigen::Matrix<double, 15, 15>::Zero();
  impl_->replay();
  return impl_->newest().state.covariance.topLeftCorner<15, 15>();
}

std::optional<common::Pose3> ErrorStateFilter::poseAt(Time time) const {
  Impl& f = *impl_;
  if (f.count == 0 || time < f.slot(0).imu.stamp) return std::nullopt;
  if (time >= f.newest().imu.stamp) {
    f.replay();
    const FilterState& last = f.newest().state;
    const double ahead_s = (time - last.stamp).seconds();
    if (ahead_s > kMaxExtrapolation_s) return std::nullopt;
    const Eigen::Vector3d turn_body_rad =
        ahead_s * (f.newest().imu.angular_velocity_body_rad_s - last.gyroscope_bias_rad_s);
    return common::Pose3{last.rotation_odom_body * common::expSO3(turn_body_rad),
                         last.position_odom_m + ahead_s * last.velocity_odom_m_s};
  }
  std::size_t low = 0, high = f.count - 1;  // slot(low).stamp <= time < slot(high).stamp
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (f.slot(middle).imu.stamp <= time ? low : high) = middle;
  }
  f.replay(high + 1);
  const FilterState& a = f.slot(low).state;
  const FilterState& b = f.slot(high).state;
  const common::Pose3 begin{a.rotation_odom_body, a.position_odom_m}, end{b.rotation_odom_body, b.position_odom_m};
  // What was measured between the two made the estimate jump there: before it counts the one, from it on the other.
  const auto measured = f.measurements.within(a.stamp, b.stamp);
  if (measured.empty()) return interpolate(begin, end, (time - a.stamp).seconds() / (b.stamp - a.stamp).seconds());
  const bool before = time < measured.front().stamp;
  const FilterState& from = before ? a : b;
  const Slot& sample = f.slot(before ? low : high);
  const double ahead_s = (time - from.stamp).seconds();
  const Eigen::Vector3d turn_body_rad = ahead_s * (sample.imu.angular_velocity_body_rad_s - from.gyroscope_bias_rad_s);
  return common::Pose3{from.rotation_odom_body * common::expSO3(turn_body_rad),
                       from.position_odom_m + ahead_s * from.velocity_odom_m_s};
}

std::optional<VerticalState> ErrorStateFilter::verticalAt(Time time) const {
  Impl& f = *impl_;
  const auto pose = poseAt(time);
  if (!pose) return std::nullopt;
  std::size_t at = f.count - 1;
  while (at > 0 && f.slot(at).imu.stamp > time) --at;
  const FilterState& state = f.slot(at).state;
  constexpr int kZ = kPosition + 2, kVz = kVelocity + 2;
  VerticalState vertical{pose->position_m.z(), state.velocity_odom_m_s.z(), Eigen::Matrix2d::Zero()};
  vertical.covariance << state.covariance(kZ, kZ) + state.height_common_variance_m2, state.covariance(kZ, kVz),
      state.covariance(kVz, kZ), state.covariance(kVz, kVz);
  return vertical;
}

PoseHistory ErrorStateFilter::poses(Time from, Time to) const {
  Impl& f = *impl_;
  std::vector<common::StampedPose> poses;
  if (f.count == 0) return {};
  f.replay();
  for (std::size_t i = 0; i < f.count; ++i) {
    const FilterState& s = f.slot(i).state;
    const bool ends_before = i + 1 < f.count && f.slot(i + 1).state.stamp <= from;
    if (ends_before) continue;
    poses.push_back({s.stamp, {s.rotation_odom_body, s.position_odom_m}});
    if (s.stamp >= to) break;
  }
  if (!poses.empty() && poses.back().stamp < to) {
    const Time end = std::min(to, poses.back().stamp + Duration::fromSeconds(kMaxExtrapolation_s));
    if (const auto pose = poseAt(end)) poses.push_back({end, *pose});
  }
  return PoseHistory(std::move(poses));
}

FusionHealth ErrorStateFilter::health() const {
  Impl& f = *impl_;
  if (f.count == 0) return {FusionStatus::kNotInitialized, "not initialized"};
  f.replay();
  const FilterState& s = f.newest().state;
  if (f.diverged) {
    return {
        FusionStatus::kDiverged,
        fmt::format("diverged: speed {:.1f} m/s, velocity sigma {:.2f} m/s, {} forced recoveries",
                    s.velocity_odom_m_s.norm(),
                    std::sqrt(std::max(0.0, s.covariance.diagonal().segment<3>(kVelocity).maxCoeff())), s.recoveries)};
  }
  const bool rests = f.newest().at_rest;
  const double relative_age_s = (s.stamp - s.relative_gate.last_accepted).seconds();
  const double height_age_s = (s.stamp - s.height_gate.last_accepted).seconds();
  if (!f.horizontalFresh(s, rests))
    return {FusionStatus::kDegraded, fmt::format("no usable relative pose for {:.2f} s", relative_age_s)};
  if (!rests && height_age_s > f.config.vertical_timeout_s)
    return {FusionStatus::kDegraded, fmt::format("no usable height for {:.2f} s", height_age_s)};
  if (s.recent_recoveries > 0 && (s.stamp - s.last_recovery).seconds() < f.config.recovery_window_s)
    return {FusionStatus::kDegraded, fmt::format("gate forced open {} times", s.recent_recoveries)};
  return {FusionStatus::kOk, ""};
}

FusionCounts ErrorStateFilter::counts() const {
  Impl& f = *impl_;
  FusionCounts out = f.counters;
  if (f.count == 0) return out;
  f.replay();
  out.replays = f.counters.replays;
  const FilterState& s = f.newest().state;
  out.relative_poses_gated = s.relative_gate.rejected;
  out.heights_gated = s.height_gate.rejected;
  out.recoveries = s.recoveries;
  return out;
}

void ErrorStateFilter::Config::describe(common::config::Fields& fields) {
  fields("history_s", history_s, "How late a measurement may come.");
  fields("gravity_m_s2", gravity_m_s2, "Magnitude of gravity.");
  fields("accelerometer_noise_m_s2_rthz", accelerometer_noise_m_s2_rthz, "Accelerometer noise density.");
  fields("gyroscope_noise_rad_s_rthz", gyroscope_noise_rad_s_rthz, "Gyroscope noise density.");
  fields("accelerometer_bias_walk_m_s3_rthz", accelerometer_bias_walk_m_s3_rthz, "Accelerometer bias random walk.");
  fields("gyroscope_bias_walk_rad_s2_rthz", gyroscope_bias_walk_rad_s2_rthz, "Gyroscope bias random walk.");
  fields("accelerometer_bias_sigma_m_s2", accelerometer_bias_sigma_m_s2, "Accelerometer bias at the start.");
  fields("use_ahrs", use_ahrs, "Take roll and pitch of the vehicle's own AHRS as a measurement.");
  fields("ahrs_sigma_deg", ahrs_sigma_deg, "Standard deviation of its roll and pitch.");
  fields("ahrs_correlation_s", ahrs_correlation_s, "How long its error keeps.");
  fields("use_gravity", use_gravity, "Take the specific force for gravity (vehicles without an AHRS).");
  fields("gravity_sigma_m_s2", gravity_sigma_m_s2, "What the vehicle's own acceleration adds to it.");
  fields("attitude_rate_hz", attitude_rate_hz, "How often either is used.");
  fields("use_drag", use_drag, "Take the specific force in the body's x and y for drag, which tells the speed.");
  fields("drag_1_s", drag_1_s, "Deceleration per speed through the air, at the start; learned in flight.");
  fields("drag_sigma_1_s", drag_sigma_1_s, "Standard deviation of that.");
  fields("drag_walk_1_s_rts", drag_walk_1_s_rts, "Its random walk.");
  fields("drag_noise_m_s2_rthz", drag_noise_m_s2_rthz, "Noise density of the force that is taken for drag.");
  fields("wind_sigma_m_s", wind_sigma_m_s, "Standard deviation of each component of the wind at the start.");
  fields("wind_walk_m_s_rts", wind_walk_m_s_rts, "Its random walk.");
  fields("rest_s", rest_s, "Stretch at rest that the start averages.");
  fields("rest_gyroscope_sigma_rad_s", rest_gyroscope_sigma_rad_s, "More spread of the gyroscope: it is moving.");
  fields("rest_accelerometer_sigma_m_s2", rest_accelerometer_sigma_m_s2, "More spread of the accelerometer: moving.");
  fields("zero_velocity_sigma_m_s", zero_velocity_sigma_m_s, "Of the zero velocity measured at rest.");
  fields("zero_rotation_sigma_rad_s", zero_rotation_sigma_rad_s, "Of the zero rotation measured at rest.");
  fields("gate_sigma", gate_sigma, "Measurements farther off than this are outliers.");
  fields("recovery_s", recovery_s, "A gate closed for this long is opened by force.");
  fields("max_recoveries", max_recoveries, "More of them within the window: diverged.");
  fields("recovery_window_s", recovery_window_s, "That window.");
  fields("max_speed_m_s", max_speed_m_s, "A faster estimate is a divergence.");
  fields("horizontal_timeout_s", horizontal_timeout_s, "Without a relative pose for this long: degraded.");
  fields("vertical_timeout_s", vertical_timeout_s, "Without a height for this long: degraded.");
  fields("valid_velocity_sigma_m_s", valid_velocity_sigma_m_s, "Up to here the velocity is good for control.");
  fields("valid_height_sigma_m", valid_height_sigma_m, "Up to here the height is good for control.");
  fields("diverged_velocity_sigma_m_s", diverged_velocity_sigma_m_s, "Beyond this the filter has diverged.");
}

std::vector<std::string> ErrorStateFilter::Config::validate() const {
  return common::Validation()
      .within("history_s", history_s, 0.1, 10)
      .within("gravity_m_s2", gravity_m_s2, 9.7, 9.9)
      .positive("accelerometer_noise_m_s2_rthz", accelerometer_noise_m_s2_rthz)
      .positive("gyroscope_noise_rad_s_rthz", gyroscope_noise_rad_s_rthz)
      .positive("accelerometer_bias_walk_m_s3_rthz", accelerometer_bias_walk_m_s3_rthz)
      .positive("gyroscope_bias_walk_rad_s2_rthz", gyroscope_bias_walk_rad_s2_rthz)
      .positive("accelerometer_bias_sigma_m_s2", accelerometer_bias_sigma_m_s2)
      .within("ahrs_sigma_deg", ahrs_sigma_deg, 0.01, 30)
      .within("ahrs_correlation_s", ahrs_correlation_s, 0, 600)
      .within("gravity_sigma_m_s2", gravity_sigma_m_s2, 0.01, 20)
      .within("attitude_rate_hz", attitude_rate_hz, 0.1, 200)
      .within("drag_1_s", drag_1_s, 0.0, 10)
      .within("drag_sigma_1_s", drag_sigma_1_s, 0.0, 10)
      .within("drag_walk_1_s_rts", drag_walk_1_s_rts, 0.0, 10)
      .positive("drag_noise_m_s2_rthz", drag_noise_m_s2_rthz)
      .within("wind_sigma_m_s", wind_sigma_m_s, 0.0, 20)
      .within("wind_walk_m_s_rts", wind_walk_m_s_rts, 0.0, 20)
      .within("rest_s", rest_s, 0.1, 10)
      .positive("rest_gyroscope_sigma_rad_s", rest_gyroscope_sigma_rad_s)
      .positive("rest_accelerometer_sigma_m_s2", rest_accelerometer_sigma_m_s2)
      .positive("zero_velocity_sigma_m_s", zero_velocity_sigma_m_s)
      .positive("zero_rotation_sigma_rad_s", zero_rotation_sigma_rad_s)
      .within("gate_sigma", gate_sigma, 1, 100)
      .within("recovery_s", recovery_s, 0.05, 10)
      .within("max_recoveries", max_recoveries, 0, 1000)
      .positive("recovery_window_s", recovery_window_s)
      .positive("max_speed_m_s", max_speed_m_s)
      .positive("horizontal_timeout_s", horizontal_timeout_s)
      .positive("vertical_timeout_s", vertical_timeout_s)
      .positive("valid_velocity_sigma_m_s", valid_velocity_sigma_m_s)
      .positive("valid_height_sigma_m", valid_height_sigma_m)
      .positive("diverged_velocity_sigma_m_s", diverged_velocity_sigma_m_s)
      .problems();
}

}  // namespace swiftlet::perception
