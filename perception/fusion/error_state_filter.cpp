// Checks the input and answers the queries. The history and its replay are in state_history, the step from sample to
// sample in filter_step, the models in imu_model and measurement_models.
#include "perception/fusion/error_state_filter.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "common/square.hpp"
#include "perception/fusion/rest_estimator.hpp"
#include "perception/fusion/state_history.hpp"

namespace swiftlet::perception {

using namespace fusion;
using common::square;
using common::Time;

namespace {

/// Standard deviation of FusionConfig::drag_1_s at the start.
constexpr double kDragSigma_1_s = 0.2;
/// Standard deviation of each component of the wind at the start.
constexpr double kWindSigma_m_s = 0.3;
/// Standard deviation of the drift of the AHRS's yaw, without a compass: indoors magnetic fields turn one
/// (docs/decisions/fusion.md#113).
constexpr double kAhrsDriftSigma_deg_s = 0.05;
/// Standard deviation up to which the velocity may be used for control. A corridor's axis is measured by the airframe's
/// drag alone, which leaves half a metre per second in gusts (docs/decisions/fusion.md#018); with less the vehicle
/// would come down in every corridor without features.
constexpr double kValidVelocitySigma_m_s = 0.7;
/// Where one odometry is used at a time, the other takes over when the first has been silent for this long
/// (OdometryChoice), and inertia carries the position until then. It is used alone for longer against a laser that
/// contradicts it (docs/decisions/fusion.md#091).
constexpr double kTakesOver_s = 0.7;

/// Position and yaw are zero by definition. Gravity shows only the sum of tilt and accelerometer bias: both start with
/// a wide covariance, and one gravity measurement correlates them.
FilterState stateAtRest(const ErrorStateFilter::Config& config, const RestEstimate& rest, Time now, double height_m) {
  FilterState state;
  state.stamp = now;
  state.position_odom_m.z() = height_m;
  state.rotation_odom_body = rest.rotation_level_body;
  state.gyroscope_bias_rad_s = rest.angular_velocity_body_rad_s;
  state.drag_1_s = config.drag_1_s;
  state.relative_gate.last_accepted = state.height_gate.last_accepted = now;

  auto diagonal = state.covariance.diagonal();
  diagonal.segment<3>(kPosition) << 1e-8, 1e-8, square(common::kStandingHeightSigma_m);
  diagonal.segment<3>(kVelocity).setConstant(square(config.zero_velocity_sigma_m_s));
  diagonal.segment<3>(kAttitude) << square(0.2), square(0.2), 1e-8;
  diagonal.segment<3>(kAccelerometerBias).setConstant(square(config.accelerometer_bias_sigma_m_s2));
  diagonal.segment<3>(kGyroscopeBias).setConstant(square(rest.gyroscope_mean_sigma_rad_s) + 1e-8);
  diagonal(kDrag) = square(kDragSigma_1_s);
  diagonal.segment<2>(kWind).setConstant(square(kWindSigma_m_s));
  diagonal(kAhrsOffset) = square(kUnknownYaw_rad);
  diagonal(kAhrsDrift) = square(kAhrsDriftSigma_deg_s * common::kRadPerDeg);
  update(state, gravity(state, rest.specific_force_body_m_s2, config.gravity_m_s2,
                        square(rest.accelerometer_mean_sigma_m_s2) + 1e-6));
  return state;
}

/// Time since a pose was last accepted, of the laser or of the camera.
double horizontalAge_s(const FilterState& s) {
  return (s.stamp - std::max(s.relative_gate.last_accepted, s.spatial_gate.last_accepted)).seconds();
}

/// Time since a height or a pose in space was last accepted.
double verticalAge_s(const FilterState& s) {
  return (s.stamp - std::max(s.height_gate.last_accepted, s.spatial_gate.last_accepted)).seconds();
}

}  // namespace

struct ErrorStateFilter::Impl {
  explicit Impl(const Config& c) : config(c), history(c), rest(c.gravity_m_s2) {}

  /// Covariance of `Rows` errors from the `first` on, by what is not known of the laser.
  template <int Rows>
  Eigen::Matrix<double, Rows, Rows> byLaser(const FilterState& state, int first) const;
  bool horizontalFresh(const Slot& newest) const;
  bool verticalFresh(const Slot& newest) const;

  Config config;
  StateHistory history;
  RestEstimator rest;
  bool at_rest = false;
  bool predicted = false;
  Time newest_seen;
  bool any_seen = false;
  double camera_delay_s = 0.0;  ///< Of the last pose in space, behind the newest sample when it came.
  FusionCounts counters;
};

template <int Rows>
Eigen::Matrix<double, Rows, Rows> ErrorStateFilter::Impl::byLaser(const FilterState& state, int first) const {
  const Eigen::Vector4d sigma(config.laser_yaw_sigma_deg * common::kRadPerDeg, config.laser_position_sigma_m,
                              config.laser_position_sigma_m, config.laser_clock_sigma_s);
  const Eigen::Matrix<double, Rows, kLaserSize> errors = state.by_laser.middleRows<Rows>(first) * sigma.asDiagonal();
  return errors * errors.transpose();
}

/// A camera that is late is not silent: a pose is as old as its delay when it comes, and older until the next one.
bool ErrorStateFilter::Impl::horizontalFresh(const Slot& newest) const {
  const FilterState& s = newest.state;
  const double laser_s = (s.stamp - s.relative_gate.last_accepted).seconds();
  const double camera_s = (s.stamp - s.spatial_gate.last_accepted).seconds() - camera_delay_s;
  const double takes_over_s = config.odometry_choice == OdometryRule::kBest ? kTakesOver_s : 0.0;
  return newest.at_rest || std::min(laser_s, camera_s) <= config.horizontal_timeout_s + takes_over_s;
}

bool ErrorStateFilter::Impl::verticalFresh(const Slot& newest) const {
  return newest.at_rest || verticalAge_s(newest.state) <= config.vertical_timeout_s;
}

ErrorStateFilter::ErrorStateFilter(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
ErrorStateFilter::~ErrorStateFilter() = default;
ErrorStateFilter::ErrorStateFilter(ErrorStateFilter&&) noexcept = default;
ErrorStateFilter& ErrorStateFilter::operator=(ErrorStateFilter&&) noexcept = default;

void ErrorStateFilter::predict(const common::ImuSample& sample) {
  Impl& f = *impl_;
  const Time now = sample.stamps.measured;
  const bool attitude_used = f.config.use_ahrs || f.predicted;
  const bool usable = sample.angular_velocity_body_rad_s.allFinite() && sample.specific_force_body_m_s2.allFinite() &&
                      (!attitude_used || std::abs(sample.rotation_ahrs_body.norm() - 1.0) < 0.01) &&
                      (!f.any_seen || now > f.newest_seen);
  if (!usable) {
    ++f.counters.imu_dropped;
    return;
  }
  f.newest_seen = now;
  f.any_seen = true;
  if (!f.predicted) f.rest.add(sample);
  if (!f.history.empty()) f.history.push(sample, f.at_rest, f.predicted);
}

tl::expected<void, std::string> ErrorStateFilter::initialize(double height_m) {
  Impl& f = *impl_;
  if (!std::isfinite(height_m)) return tl::unexpected(std::string("the height at rest is not known"));
  const auto rest = f.rest.estimate();
  if (!rest) return tl::unexpected(rest.error());

  Slot first;
  first.imu = {f.newest_seen, rest->angular_velocity_body_rad_s, rest->specific_force_body_m_s2};
  first.state = stateAtRest(f.config, *rest, f.newest_seen, height_m);
  f.history.start(first);
  return {};
}

std::optional<Eigen::Quaterniond> ErrorStateFilter::attitudeAtRest() const {
  const auto rest = impl_->rest.estimate();
  return rest ? std::optional(rest->rotation_level_body) : std::nullopt;
}

bool ErrorStateFilter::initialized() const { return !impl_->history.empty(); }

void ErrorStateFilter::setAtRest(bool at_rest) { impl_->at_rest = at_rest; }

bool ErrorStateFilter::atRest() const { return impl_->at_rest; }

void ErrorStateFilter::setPredicted(bool predicted) { impl_->predicted = predicted; }

bool ErrorStateFilter::predicted() const { return impl_->predicted; }

Insertion ErrorStateFilter::add(const Measurement& m) {
  Impl& f = *impl_;
  const bool relative = m.kind == MeasurementKind::kRelativePose || m.kind == MeasurementKind::kRelativePose3;
  const Insertion outcome = !isValid(m)                     ? Insertion::kInvalid
                            : relative && !hasClone(m.from) ? Insertion::kUnknownReference
                                                            : f.history.insert(m);
  if (outcome == Insertion::kTaken && m.kind == MeasurementKind::kRelativePose3)
    f.camera_delay_s = std::max(0.0, (f.newest_seen - m.stamp).seconds());
  ++(outcome == Insertion::kTaken ? f.counters.measurements : f.counters.refused);
  return outcome;
}

bool ErrorStateFilter::hasClone(Time time) const { return impl_->history.holdsClone(time); }

common::VehicleState ErrorStateFilter::state() const {
  Impl& f = *impl_;
  common::VehicleState out;
  if (f.history.empty()) {
    out.stamp = f.newest_seen;
    return out;
  }
  const Slot& newest = f.history.newest();
  const FilterState& s = newest.state;
  out.stamp = s.stamp;
  out.T_odom_body = {s.rotation_odom_body, s.position_odom_m};
  out.velocity_odom_m_s = s.velocity_odom_m_s;
  out.angular_velocity_body_rad_s = newest.imu.angular_velocity_body_rad_s - s.gyroscope_bias_rad_s;
  out.position_covariance_m2 = s.covariance.block<3, 3>(kPosition, kPosition);
  out.velocity_covariance_m2_s2 = s.covariance.block<3, 3>(kVelocity, kVelocity);
  out.height_above_ground_m = s.position_odom_m.z();

  const auto velocity_sigma = out.velocity_covariance_m2_s2.diagonal().cwiseMax(0.0).cwiseSqrt().eval();
  out.horizontal_valid = !f.history.diverged() && f.horizontalFresh(newest) &&
                         velocity_sigma.head<2>().maxCoeff() <= kValidVelocitySigma_m_s;
  // How high that lies which is measured below may be unknown: the vehicle keeps its height over it.
  out.vertical_valid =
      !f.history.diverged() && f.verticalFresh(newest) && velocity_sigma.z() <= kValidVelocitySigma_m_s;
  out.position_covariance_m2 += f.byLaser<3>(s, kPosition);
  out.velocity_covariance_m2_s2 += f.byLaser<3>(s, kVelocity);
  return out;
}

Time ErrorStateFilter::newest() const { return impl_->newest_seen; }

FusionEstimate ErrorStateFilter::estimate() const {
  Impl& f = *impl_;
  FusionEstimate out;
  out.drag_1_s = f.config.drag_1_s;
  if (f.history.empty()) return out;
  const Slot& newest = f.history.newest();
  const FilterState& s = newest.state;
  out.acceleration_odom_m_s2 =
      s.rotation_odom_body * (newest.imu.specific_force_body_m_s2 - s.accelerometer_bias_m_s2) -
      Eigen::Vector3d(0.0, 0.0, f.config.gravity_m_s2);
  out.accelerometer_bias_m_s2 = s.accelerometer_bias_m_s2;
  out.gyroscope_bias_rad_s = s.gyroscope_bias_rad_s;
  out.drag_1_s = s.drag_1_s;
  out.covariance = s.covariance.topLeftCorner<15, 15>() + f.byLaser<15>(s, 0);
  return out;
}

std::optional<common::Pose3> ErrorStateFilter::poseAt(Time time) const { return impl_->history.poseAt(time); }

std::optional<VerticalMotion> ErrorStateFilter::verticalAt(Time time, std::optional<Time> since) const {
  const auto state = impl_->history.verticalAt(time);
  if (!state) return std::nullopt;
  return VerticalMotion{*state, since ? impl_->history.climb(*since, time) : std::nullopt};
}

PoseHistory ErrorStateFilter::motion(Time from, Time to) const { return impl_->history.motion(from, to); }

FusionStatus ErrorStateFilter::status() const {
  Impl& f = *impl_;
  if (f.history.empty()) return FusionStatus::kNotInitialized;
  if (f.history.diverged()) return FusionStatus::kDiverged;
  const Slot& newest = f.history.newest();
  const FilterState& s = newest.state;
  const bool recovered =
      s.recoveries.recent > 0 && (s.stamp - s.recoveries.last).seconds() < f.config.recovery_window_s;
  return f.horizontalFresh(newest) && f.verticalFresh(newest) && !recovered ? FusionStatus::kOk
                                                                            : FusionStatus::kDegraded;
}

FusionHealth ErrorStateFilter::health() const {
  Impl& f = *impl_;
  const FusionStatus now = status();
  if (now == FusionStatus::kNotInitialized) return {now, "not initialized"};
  if (now == FusionStatus::kOk) return {now, ""};
  const Slot& newest = f.history.newest();
  const FilterState& s = newest.state;
  if (now == FusionStatus::kDiverged)
    return {now, fmt::format("diverged: speed {:.1f} m/s, velocity sigma {:.2f} m/s, {} forced recoveries",
                             s.velocity_odom_m_s.norm(),
                             std::sqrt(std::max(0.0, s.covariance.diagonal().segment<3>(kVelocity).maxCoeff())),
                             s.recoveries.all)};
  if (!f.horizontalFresh(newest)) return {now, fmt::format("no usable relative pose for {:.2f} s", horizontalAge_s(s))};
  if (!f.verticalFresh(newest)) return {now, fmt::format("no usable height for {:.2f} s", verticalAge_s(s))};
  return {now, fmt::format("gate forced open {} times", s.recoveries.recent)};
}

bool ErrorStateFilter::refusesRelativePoses() const {
  return !impl_->history.empty() && impl_->history.newest().state.relative_gate.closed;
}

FusionCounts ErrorStateFilter::counts() const {
  Impl& f = *impl_;
  FusionCounts out = f.counters;
  if (f.history.empty()) return out;
  const FilterState& s = f.history.newest().state;
  out.replays = f.history.replays();
  out.relative_poses_gated = s.relative_gate.rejected;
  out.heights_gated = s.height_gate.rejected;
  out.recoveries = s.recoveries.all;
  out.relative_poses = s.relative_gate.innovations;
  out.heights = s.height_gate.innovations;
  return out;
}

}  // namespace swiftlet::perception
