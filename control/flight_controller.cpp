#include "control/flight_controller.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "control/attitude_step.hpp"
#include "control/usable_state.hpp"

namespace swiftlet::control {

using common::FlightState;
using common::Severity;

namespace {

/// Slower than this the drag is less than the error of the horizon.
constexpr double kTrimmedSpeed_m_s = 0.3;
/// Deviation up to which a carried vertical speed is better than that of the thrust model.
constexpr double kCarriedSpeedSigma_m_s = 0.5;
/// When the position is unknown, a velocity with at most this deviation is still damped.
constexpr double kDampedVelocitySigma_m_s = 0.6;

constexpr const char* kEscapes = "the vehicle leaves the walls without a position";

Eigen::Vector3d inFrame(const common::Pose2& T, const Eigen::Vector3d& point_m) {
  const Eigen::Vector2d planar_m = T * Eigen::Vector2d(point_m.head<2>());
  return {planar_m.x(), planar_m.y(), point_m.z()};
}

}  // namespace

FlightController::FlightController(const Config& config, const common::VehicleConfig& vehicle, common::EventLog& log,
                                   const VehicleModel* model)
    : config_(config),
      margin_(config.margin),
      follower_(config.path),
      position_(config.controller, config.position, vehicle, model),
      emergency_(config.emergency),
      clearance_(config.clearance),
      oscillation_(config.oscillation),
      log_(log),
      dt_s_(common::kControlPeriod.seconds()),
      max_height_m_(vehicle.max_height_m) {}

tl::expected<void, std::string> FlightController::command(const FlightCommand& command) {
  const auto apply = [this](FlightInput input, const std::string& reason) -> tl::expected<void, std::string> {
    const FlightState from = state();
    const auto result = machine_.apply(input);
    if (!result) return tl::unexpected(result.error());
    enter(from, *result);
    say(Severity::kInfo, input == FlightInput::kEngageMotors ? "motors on" : common::toString(*result), reason);
    return {};
  };
  if (std::holds_alternative<Prepared>(command)) return apply(FlightInput::kPrepared, "the estimate has started");
  if (std::holds_alternative<Land>(command)) {
    if (state() == FlightState::kLanding) return {};
    auto landing = apply(FlightInput::kLand, "commanded");
    if (landing) grounded_reason_ = "a landing was commanded";
    return landing;
  }
  if (std::holds_alternative<DisengageMotors>(command)) return apply(FlightInput::kDisengageMotors, "commanded");
  if (std::holds_alternative<EmergencyLand>(command)) {
    if (state() == FlightState::kEmergencyLanding) return {};
    auto landing = apply(FlightInput::kEmergency, "commanded");
    if (landing) grounded_reason_ = "an emergency landing was commanded";
    return landing;
  }
  const double height_m = std::get<TakeOff>(command).height_m;
  const double least_m = last_state_.T_odom_body.position_m.z() + config_.hover_tolerance_m;
  if (!std::isfinite(height_m) || height_m < least_m)
    return tl::unexpected(fmt::format("a take-off height of {:.2f} m is not above {:.2f} m", height_m, least_m));
  if (height_m > max_height_m_)
    return tl::unexpected(
        fmt::format("a take-off height of {:.2f} m is above the greatest height, {:.2f} m", height_m, max_height_m_));
  if (!inertial_fault_.empty()) return tl::unexpected("take off is not possible: " + inertial_fault_);
  if (!last_state_.horizontal_valid || !last_state_.vertical_valid)
    return tl::unexpected(std::string("take off is not possible without a valid estimate"));
  if (state() == FlightState::kPoweredOff) {
    if (auto engaged = apply(FlightInput::kEngageMotors, "to take off"); !engaged) return engaged;
  }
  take_off_height_m_ = height_m;
  return apply(FlightInput::kTakeOff, fmt::format("to {:.2f} m", height_m));
}

tl::expected<void, std::string> FlightController::follow(const FlightPath& path) {
  if (!machine_.activation().waypoints)
    return tl::unexpected(fmt::format("no paths while {}", common::toString(state())));
  if (escapes_until_) return tl::unexpected(std::string(kEscapes));
  const bool finite = std::all_of(path.points_map_m.begin(), path.points_map_m.end(),
                                  [](const Eigen::Vector3d& point) { return point.allFinite(); }) &&
                      std::isfinite(path.goal_yaw_map_rad.value_or(0.0));
  if (!finite) return tl::unexpected(std::string("the path has points that are not finite"));

  const common::Pose2 T_odom_map = T_map_odom_.inverse();
  std::vector<Eigen::Vector3d> points_odom_m;
  points_odom_m.reserve(path.points_map_m.size());
  for (Eigen::Vector3d point : path.points_map_m) {
    point.z() = std::min(point.z(), max_height_m_);
    points_odom_m.push_back(inFrame(T_odom_map, point));
  }
  std::optional<double> yaw_odom_rad;
  if (path.goal_yaw_map_rad) yaw_odom_rad = common::wrapAngle(*path.goal_yaw_map_rad + T_odom_map.yaw_rad);
  follower_.setPath(std::move(points_odom_m), path.mode, yaw_odom_rad);
  return {};
}

tl::expected<void, std::string> FlightController::followVelocity(const Eigen::Vector2d& velocity_map_m_s,
                                                                 double acceleration_m_s2, double yaw_map_rad,
                                                                 double climb_m_s) {
  if (!machine_.activation().waypoints)
    return tl::unexpected(fmt::format("no velocities while {}", common::toString(state())));
  if (escapes_until_) return tl::unexpected(std::string(kEscapes));
  if (!velocity_map_m_s.allFinite() || !std::isfinite(yaw_map_rad) || !std::isfinite(climb_m_s) ||
      !(acceleration_m_s2 > 0.0))
    return tl::unexpected(std::string("the velocity is not finite"));
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  velocity_odom_m_s.head<2>() = Eigen::Rotation2Dd(-T_map_odom_.yaw_rad) * velocity_map_m_s;
  velocity_odom_m_s.z() = climb_m_s;
  follower_.setVelocity(velocity_odom_m_s, acceleration_m_s2, common::wrapAngle(yaw_map_rad - T_map_odom_.yaw_rad));
  return {};
}

void FlightController::hold() {
  if (escapes_until_) return;  // The escape ends in a hold by itself.
  follower_.stop();
}

common::Setpoint FlightController::tick(const FlightTick& given) {
  FlightTick tick = given;
  const bool old = tick.state.inertialAge_s(tick.now) > config_.inertial_age_s;
  if (tick.inertial_fault.empty() && old) tick.inertial_fault = "the estimate is old";
  if (old || !isFinite(tick.state)) tick.state.horizontal_valid = false;
  // The first ticks after a pause must not integrate over it.
  constexpr double kPeriod_s = common::kControlPeriod.seconds();
  dt_s_ = ticked_ ? std::clamp((tick.now - now_).seconds(), 1e-3, 5.0 * kPeriod_s) : kPeriod_s;
  ticked_ = true;
  now_ = tick.now;
  if (tick.raw_height) emergency_.observe(*tick.raw_height);
  if (tick.raw_height && tick.state.vertical_valid && isFinite(tick.state))
    clearance_.observe(*tick.raw_height, tick.state.T_odom_body.position_m.z());
  if (isFinite(tick.state)) {
    keepPathInMap(tick.state);
    last_state_ = tick.state;
  }
  watch(tick);
  if (tick.pilot_flies && isAirborne(state())) beginAtVehicle();
  limitByMargin(tick);
  common::Setpoint setpoint = setpointFor(tick);
  setpoint.stamp = now_;
  return setpoint;
}

common::Setpoint FlightController::setpointFor(const FlightTick& tick) {
  common::Setpoint setpoint;
  switch (state()) {
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
      position_.thrust().observeVoltage(tick.battery_v, dt_s_);
      return setpoint;
    case FlightState::kLanded:
      position_.thrust().observeVoltage(tick.battery_v, dt_s_);
      setpoint.motors_on = true;
      return setpoint;
    case FlightState::kTakingOff:
      return takeOff(tick);
    case FlightState::kFlying:
      return fly(tick);
    case FlightState::kLanding:
      return descend(tick);
    case FlightState::kEmergencyLanding:
      return descendInEmergency(tick);
  }
  return setpoint;
}

/// The vehicle flies behind its reference, by 6 deg of an orbit of 1.4 m at 0.5 m/s. Moved by that lag, the point is
/// seen from the reference where the vehicle sees it.
std::optional<Eigen::Vector2d> FlightController::pointToFace() const {
  if (!look_at_map_m_) return std::nullopt;
  const Eigen::Vector3d lag_m = follower_.reference().position_odom_m - last_state_.T_odom_body.position_m;
  return T_map_odom_.inverse() * *look_at_map_m_ + Eigen::Vector2d(lag_m.head<2>());
}

common::Setpoint FlightController::fly(const FlightTick& tick) {
  follower_.lookAt(pointToFace());
  return track(tick, clearOfSurfaces(follower_.advance(dt_s_)));
}

/// A path leads across tables at one height; over them the vehicle flies higher.
Reference FlightController::clearOfSurfaces(Reference reference) {
  clearance_.advance(now_, reference.position_odom_m.z(), dt_s_);
  const double height_m = std::min(reference.position_odom_m.z() + clearance_.lift_m(),
                                   std::max(max_height_m_, reference.position_odom_m.z()));
  lift_m_ = height_m - reference.position_odom_m.z();
  if (lift_m_ > 0.0) reference.velocity_odom_m_s.z() += clearance_.rate_m_s();
  reference.position_odom_m.z() = height_m;
  return reference;
}

/// The thrust is the emergency descent's. A horizontal estimate that is still good holds the place, or its velocity.
common::Setpoint FlightController::descendInEmergency(const FlightTick& tick) {
  std::optional<VerticalMotion> carried;
  const double variance = last_state_.velocity_covariance_m2_s2(2, 2);
  if (tick.inertial_fault.empty() && !tick.fusion_diverged && isFinite(tick.state) &&
      variance < kCarriedSpeedSigma_m_s * kCarriedSpeedSigma_m_s)
    carried = VerticalMotion{last_state_.height_above_ground_m, last_state_.velocity_odom_m_s.z()};
  common::Setpoint setpoint = emergency_.tick(now_, dt_s_, position_.thrust(), carried);
  if (emergency_.touchedDown()) {
    transition(FlightInput::kTouchedDown, "emergency landing ended on the ground");
  } else if (tick.state.horizontal_valid || carried) {
    // Without a position the velocity that inertial samples carry is damped. Without a vertical error the position
    // controller leaves its hover command as it is.
    height_reference_m_ = tick.state.T_odom_body.position_m.z();
    climb_reference_m_s_ = tick.state.velocity_odom_m_s.z();
    const common::Setpoint held = track(tick, follower_.advance(dt_s_));
    setpoint.roll_rad = held.roll_rad;
    setpoint.pitch_rad = held.pitch_rad;
    setpoint.yaw_rate_rad_s = held.yaw_rate_rad_s;
    return setpoint;
  }
  position_.thrust().observeVoltage(tick.battery_v, dt_s_);
  return setpoint;
}

common::Setpoint FlightController::track(const FlightTick& tick, const Reference& reference, bool on_ground) {
  Reference target = reference;
  if (state() != FlightState::kFlying) {
    target.position_odom_m.z() = height_reference_m_;
    target.velocity_odom_m_s.z() = climb_reference_m_s_;
    target.acceleration_odom_m_s2.z() = 0.0;
  }
  Horizontal horizontal = Horizontal::kPosition;
  if (!tick.state.horizontal_valid) {
    const double variance = last_state_.velocity_covariance_m2_s2.diagonal().head<2>().maxCoeff();
    horizontal = variance < kDampedVelocitySigma_m_s * kDampedVelocitySigma_m_s && !tick.fusion_diverged
                     ? Horizontal::kVelocity
                     : Horizontal::kLevel;
    // A velocity that is measured no longer would be damped beyond its end.
    if (!tick.inertial_fault.empty()) horizontal = Horizontal::kLevel;
    // The velocities of a path need its positions.
    if (!escapes_until_) target.velocity_odom_m_s.head<2>().setZero();
  }
  if (!on_ground && isFinite(tick.state)) oscillation_.observe(tick.state.T_odom_body.rotation, dt_s_);
  const ControlInput input{now_,       dt_s_,     tick.state,          target, tick.acceleration_odom_m_s2,
                           horizontal, on_ground, oscillation_.share()};
  common::Setpoint setpoint = position_.tick(input, tick.battery_v);
  if (on_ground || !isFinite(tick.state)) return setpoint;
  setpoint = withinThrustLeft(setpoint, tick.state.T_odom_body.rotation);
  if (tick.fusion_diverged || !tick.inertial_fault.empty()) return setpoint;
  setpoint.roll_rad += tick.horizon_offset_rad.x();
  setpoint.pitch_rad += tick.horizon_offset_rad.y();
  return setpoint;
}

tl::expected<void, std::string> FlightController::switchController(ControllerKind kind) {
  const ControllerKind from = position_.kind();
  if (auto switched = position_.switchTo(kind); !switched) return switched;
  if (from != kind) say(Severity::kInfo, fmt::format("controller {}", toString(kind)), "switched in flight");
  return {};
}

/// Until the vehicle has flown, the margin is only that of the data sheet or of an earlier flight.
void FlightController::limitByMargin(const FlightTick& tick) {
  position_.thrust().setLearning(learnsThrust(tick));
  if (state() == FlightState::kFlying || state() == FlightState::kLanding || lifted_)
    margin_.observe(position_.thrust().margin(), dt_s_);
  follower_.setShares(margin_.speed(), margin_.acceleration());
}

bool FlightController::heldFor(std::optional<common::Time>& since, bool condition, double seconds) const {
  if (!condition) {
    since.reset();
    return false;
  }
  if (!since) since = now_;
  return (now_ - *since).seconds() >= seconds;
}

void FlightController::transition(FlightInput input, const std::string& reason) {
  const FlightState from = state();
  const auto result = machine_.apply(input);
  if (!result) return;
  enter(from, *result);
  const bool bad = input == FlightInput::kEmergency || input == FlightInput::kLand;
  if (bad) grounded_reason_ = reason;
  say(bad ? Severity::kWarning : Severity::kInfo, common::toString(*result), reason,
      bad ? common::Concern::kLanding : common::Concern::kNone);
}

void FlightController::enter(FlightState from, FlightState entered) {
  state_since_ = now_;
  spent_since_.reset();
  condition_since_.reset();
  const Eigen::Vector3d& position_m = last_state_.T_odom_body.position_m;
  const double yaw_rad = common::yawOf(last_state_.T_odom_body.rotation);
  if (entered != FlightState::kLanding) escapes_until_.reset();
  switch (entered) {
    case FlightState::kTakingOff:
      grounded_reason_.clear();
      oscillation_.reset();
      standing_height_m_ = position_m.z();
      standing_raw_m_ = emergency_.filter().ready() ? emergency_.filter().height_m() : position_m.z();
      follower_.reset(position_m, yaw_rad);
      position_.reset();
      height_reference_m_ = position_m.z();
      climb_reference_m_s_ = 0.0;
      lifted_ = false;
      return;
    case FlightState::kFlying: {
      clearance_.reset();
      lift_m_ = 0.0;
      Eigen::Vector3d hover = follower_.reference().position_odom_m;
      hover.z() = take_off_height_m_;
      follower_.reset(hover, follower_.reference().yaw_odom_rad);
      return;
    }
    case FlightState::kLanding:
      // During take-off the height reference moves by itself; in flight the path moves it.
      if (from == FlightState::kFlying) {
        height_reference_m_ = follower_.reference().position_odom_m.z() + lift_m_;
        climb_reference_m_s_ = follower_.reference().velocity_odom_m_s.z();
      }
      if (!escapes_until_) follower_.stop();
      return;
    case FlightState::kEmergencyLanding:
      follower_.stop();
      startEmergencyDescent();
      return;
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanded:
      follower_.reset(position_m, yaw_rad);
      lift_m_ = 0.0;
      return;
  }
}

/// The trim of a vehicle that flies fast balances drag, which ends with the braking.
void FlightController::startEmergencyDescent() {
  const double yaw_rad = common::yawOf(last_state_.T_odom_body.rotation);
  Eigen::Vector3d trim_level_m_s2 = position_.trim_odom_m_s2();
  if (last_state_.velocity_odom_m_s.head<2>().norm() < kTrimmedSpeed_m_s)
    trim_level_m_s2.head<2>() = Eigen::Rotation2Dd(-yaw_rad) * trim_level_m_s2.head<2>();
  else
    trim_level_m_s2.head<2>().setZero();
  emergency_.start(now_, standing_raw_m_, velocityForBraking_m_s(), trim_level_m_s2);
}

/// While the pilot flies, no setpoint of the program is flown. A take-off or a landing continues from where the pilot
/// gives the vehicle back; neither a time limit nor a touch-down is counted before that.
void FlightController::beginAtVehicle() {
  const Eigen::Vector3d& position_m = last_state_.T_odom_body.position_m;
  follower_.reset(position_m, common::yawOf(last_state_.T_odom_body.rotation));
  position_.reset();
  height_reference_m_ = position_m.z();
  climb_reference_m_s_ = 0.0;
  spent_since_.reset();
  condition_since_.reset();
  if (state() == FlightState::kEmergencyLanding) startEmergencyDescent();
  const auto spool_up = common::Duration::fromSeconds(config_.spool_up_s);
  if (state() == FlightState::kTakingOff && now_ - state_since_ > spool_up) state_since_ = now_ - spool_up;
}

/// The last horizontal velocity that is still known well enough, in the body frame without roll and pitch.
Eigen::Vector2d FlightController::velocityForBraking_m_s() const {
  const double variance = last_state_.velocity_covariance_m2_s2.diagonal().head<2>().maxCoeff();
  if (variance > kDampedVelocitySigma_m_s * kDampedVelocitySigma_m_s) return Eigen::Vector2d::Zero();
  return Eigen::Rotation2Dd(-common::yawOf(last_state_.T_odom_body.rotation)) *
         Eigen::Vector2d(last_state_.velocity_odom_m_s.head<2>());
}

bool FlightController::stopped() const {
  if (!isAirborne(state())) return true;
  if (state() != FlightState::kFlying) return false;
  return follower_.reference().velocity_odom_m_s.norm() < config_.stopped_speed_m_s &&
         last_state_.velocity_odom_m_s.norm() < config_.stopped_speed_m_s;
}

void FlightController::say(Severity severity, std::string text, std::string reason, common::Concern concern) {
  log_.add({now_, severity, "flight", std::move(text), std::move(reason), {}, concern});
}

}  // namespace swiftlet::control
