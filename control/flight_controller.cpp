#include "control/flight_controller.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "common/config_fields.hpp"
#include "common/gravity.hpp"
#include "control/attitude_step.hpp"
#include "control/failsafe.hpp"
#include "control/usable_state.hpp"

namespace swiftlet::control {

using common::FlightState;

namespace {

constexpr const char* kFlight = "flight";
/// An estimate whose newest inertial sample is older than this cannot be used.
constexpr double kInertialAge_s = 0.1;
constexpr double kStopped_m_s = 0.10;  ///< Slower than this the vehicle has stopped.
/// Slower than this the drag is less than the error of the horizon.
constexpr double kTrimmedSpeed_m_s = 0.3;
/// Deviation up to which a carried vertical speed is better than that of the thrust model.
constexpr double kCarriedSpeedSigma_m_s = 0.5;
/// When the position is unknown, a velocity with at most this deviation is still damped.
constexpr double kDampedVelocitySigma_m_s = 0.6;

Eigen::Vector3d inFrame(const common::Pose2& T, const Eigen::Vector3d& point_m) {
  const Eigen::Vector2d planar_m = T * Eigen::Vector2d(point_m.head<2>());
  return {planar_m.x(), planar_m.y(), point_m.z()};
}

}  // namespace

FlightController::FlightController(const Config& config, const common::VehicleConfig& vehicle, common::EventLog& log,
                                   const VehicleModel* model, const ThrustPoints& learned)
    : vertical_(config.climb_m_s, config.descent_m_s, vehicle.max_height_m),
      follower_(config.path),
      position_(config.controller, config.position, vehicle, model),
      clearance_(config.clearance),
      watch_(log),
      log_(log) {
  position_.thrust().table().recall(learned);
}

tl::expected<void, std::string> FlightController::command(const FlightCommand& command) {
  if (std::holds_alternative<Prepared>(command)) return apply(FlightInput::kPrepared, "the estimate has started");
  if (std::holds_alternative<DisengageMotors>(command)) return apply(FlightInput::kDisengageMotors, "commanded");
  if (std::holds_alternative<Land>(command))
    return comeDown(FlightInput::kLand, FlightState::kLanding, "a landing was commanded");
  if (std::holds_alternative<EmergencyLand>(command))
    return comeDown(FlightInput::kEmergency, FlightState::kEmergencyLanding, "an emergency landing was commanded");
  if (const auto* switched = std::get_if<SwitchController>(&command)) return switchTo(switched->kind);
  return takeOffTo(std::get<TakeOff>(command).height_m);
}

tl::expected<void, std::string> FlightController::apply(FlightInput input, const std::string& reason) {
  const FlightState from = state();
  const auto result = machine_.apply(input);
  if (!result) return tl::unexpected(result.error());
  enter(from, *result);
  log_.info(clock_.now(), kFlight, input == FlightInput::kEngageMotors ? "motors on" : common::toString(*result),
            reason);
  return {};
}

tl::expected<void, std::string> FlightController::takeOffTo(double height_m) {
  const std::string refusal = vertical_.refusal(height_m, last_state_.T_odom_body.position_m.z());
  if (!refusal.empty()) return tl::unexpected(refusal);
  if (!watch_.inertialFault().empty()) return tl::unexpected("take off is not possible: " + watch_.inertialFault());
  if (!last_state_.horizontal_valid || !last_state_.vertical_valid)
    return tl::unexpected(std::string("take off is not possible without a valid estimate"));
  if (state() == FlightState::kPoweredOff) {
    if (auto engaged = apply(FlightInput::kEngageMotors, "to take off"); !engaged) return engaged;
  }
  auto taking_off = apply(FlightInput::kTakeOff, fmt::format("to {:.2f} m", height_m));
  if (taking_off) vertical_.setGoal(height_m);
  return taking_off;
}

tl::expected<void, std::string> FlightController::comeDown(FlightInput input, FlightState already, const char* reason) {
  if (state() == already) return {};
  auto landing = apply(input, "commanded");
  if (landing) grounded_reason_ = reason;
  return landing;
}

tl::expected<void, std::string> FlightController::switchTo(ControllerKind kind) {
  const ControllerKind from = position_.kind();
  if (auto switched = position_.switchTo(kind); !switched) return switched;
  if (from != kind)
    log_.info(clock_.now(), kFlight, fmt::format("controller {}", toString(kind)), "switched in flight");
  return {};
}

std::string FlightController::refusalToFollow(std::string_view what) const {
  if (!machine_.activation().waypoints) return fmt::format("no {} while {}", what, common::toString(state()));
  return escape_.active() ? "the vehicle flies away from the walls without a position" : std::string();
}

tl::expected<void, std::string> FlightController::follow(const FlightPath& path) {
  if (std::string refusal = refusalToFollow("paths"); !refusal.empty()) return tl::unexpected(std::move(refusal));
  const bool finite = std::all_of(path.points_map_m.begin(), path.points_map_m.end(),
                                  [](const Eigen::Vector3d& point) { return point.allFinite(); }) &&
                      std::all_of(path.facings_map.begin(), path.facings_map.end(),
                                  [](const common::Facing& facing) {
                                    return facing.place_m.allFinite() && std::isfinite(facing.yaw_rad);
                                  }) &&
                      std::isfinite(path.goal_yaw_map_rad.value_or(0.0));
  if (!finite) return tl::unexpected(std::string("the path has points that are not finite"));

  const common::Pose2 T_odom_map = last_state_.T_map_odom.inverse();
  std::vector<Eigen::Vector3d> points_odom_m;
  points_odom_m.reserve(path.points_map_m.size());
  for (Eigen::Vector3d point : path.points_map_m) {
    point.z() = std::min(point.z(), maxHeight_m());
    points_odom_m.push_back(inFrame(T_odom_map, point));
  }
  std::optional<double> yaw_odom_rad;
  if (path.goal_yaw_map_rad) yaw_odom_rad = common::wrapAngle(*path.goal_yaw_map_rad + T_odom_map.yaw_rad);
  common::ClearanceAlong clearance_m;
  if (path.clearance_m)
    clearance_m = [&](const Eigen::Vector3d& from_odom_m, const Eigen::Vector3d& to_odom_m) {
      return path.clearance_m(inFrame(last_state_.T_map_odom, from_odom_m), inFrame(last_state_.T_map_odom, to_odom_m));
    };
  std::vector<common::Facing> facings_odom = path.facings_map;
  for (common::Facing& facing : facings_odom) {
    facing.place_m = T_odom_map * facing.place_m;
    facing.yaw_rad = common::wrapAngle(facing.yaw_rad + T_odom_map.yaw_rad);
  }
  follower_.setPath(std::move(points_odom_m), path.mode, yaw_odom_rad, std::move(facings_odom), clearance_m);
  return {};
}

tl::expected<void, std::string> FlightController::followVelocity(const Eigen::Vector2d& velocity_map_m_s,
                                                                 double acceleration_m_s2, double yaw_map_rad,
                                                                 double climb_m_s) {
  if (std::string refusal = refusalToFollow("velocities"); !refusal.empty()) return tl::unexpected(std::move(refusal));
  if (!velocity_map_m_s.allFinite() || !std::isfinite(yaw_map_rad) || !std::isfinite(climb_m_s) ||
      !(acceleration_m_s2 > 0.0))
    return tl::unexpected(std::string("the velocity is not finite"));
  const double yaw_map_odom_rad = last_state_.T_map_odom.yaw_rad;
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  velocity_odom_m_s.head<2>() = Eigen::Rotation2Dd(-yaw_map_odom_rad) * velocity_map_m_s;
  velocity_odom_m_s.z() = climb_m_s;
  follower_.setVelocity(velocity_odom_m_s, acceleration_m_s2, common::wrapAngle(yaw_map_rad - yaw_map_odom_rad));
  return {};
}

void FlightController::hold() {
  if (escape_.active()) return;  // The escape ends in a hold by itself.
  follower_.stop();
}

common::Setpoint FlightController::tick(const FlightTick& given) {
  FlightTick tick = given;
  const bool old = tick.state.inertialAge_s(tick.now) > kInertialAge_s;
  const bool finite = isFinite(tick.state);
  if (tick.inertial_fault.empty() && old) tick.inertial_fault = "the estimate is old";
  if (old || !finite) tick.state.horizontal_valid = false;
  clock_.advance(tick.now);
  if (tick.raw_height) emergency_.observe(*tick.raw_height);
  if (tick.raw_height && tick.state.vertical_valid && finite)
    clearance_.observe(*tick.raw_height, tick.state.T_odom_body.position_m.z());
  if (finite) {
    keepPathInMap(tick.state.T_map_odom);
    last_state_ = tick.state;
  }
  watch(tick);
  if (tick.pilot_flies && isAirborne(state())) beginAtVehicle();
  limitByMargin(tick);
  common::Setpoint setpoint = setpointFor(tick);
  setpoint.stamp = clock_.now();
  return setpoint;
}

void FlightController::keepPathInMap(const common::Pose2& T_map_odom) {
  const common::Pose2& before = last_state_.T_map_odom;
  const bool same =
      T_map_odom.x_m == before.x_m && T_map_odom.y_m == before.y_m && T_map_odom.yaw_rad == before.yaw_rad;
  if (!same) follower_.movePath(T_map_odom.inverse() * before);
}

/// Until the vehicle has flown, the margin is only that of the data sheet or of an earlier flight.
void FlightController::limitByMargin(const FlightTick& tick) {
  position_.thrust().setLearning(learnsThrust(tick));
  if (state() == FlightState::kFlying || state() == FlightState::kLanding || vertical_.lifted())
    margin_.observe(position_.thrust().margin(), clock_.dt_s());
  follower_.setShares(margin_.speed(), margin_.acceleration());
}

/// The ground may carry a part of the weight while the vehicle takes off and lands.
bool FlightController::learnsThrust(const FlightTick& tick) const {
  if (!tick.thrust_applies || tick.pilot_flies || state() == FlightState::kEmergencyLanding) return false;
  if (tick.inertial_contradicted) return false;  // The estimate follows the given thrust, whatever the vehicle weighs.
  if (state() == FlightState::kTakingOff) return vertical_.lifted();
  return state() == FlightState::kFlying || !vertical_.nearGround(last_state_);
}

common::Setpoint FlightController::setpointFor(const FlightTick& tick) {
  switch (state()) {
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanded:
      break;
    case FlightState::kTakingOff:
      return takeOff(tick);
    case FlightState::kFlying:
      follower_.lookAt(pointToFace());
      return track(tick,
                   clearance_.raised(follower_.advance(clock_.dt_s()), clock_.now(), maxHeight_m(), clock_.dt_s()));
    case FlightState::kLanding:
      return descend(tick);
    case FlightState::kEmergencyLanding:
      return descendInEmergency(tick);
  }
  position_.thrust().observeVoltage(tick.battery_v, clock_.dt_s());
  common::Setpoint setpoint;
  setpoint.motors_on = state() == FlightState::kLanded;
  return setpoint;
}

// ------------------------------------------------------------------------------------- an estimate that cannot be used

void FlightController::watch(const FlightTick& tick) {
  const common::Time now = clock_.now();
  watch_.observe(now, isFinite(tick.state) && tick.state.vertical_valid, tick.inertial_fault);
  if (state() == FlightState::kEmergencyLanding) return;
  const Failsafe* row = watch_.active(now, phaseOf(state()), tick.fusion_diverged);
  if (row != nullptr && row->response >= Response::kDescend)
    return transition(FlightInput::kEmergency, watch_.reason(row->finding));
  if (!isAirborne(state())) return;
  watchHorizontal(tick);
  row = watch_.active(now, phaseOf(state()), false);
  if (row != nullptr && row->response == Response::kLand) transition(FlightInput::kLand, watch_.reason(row->finding));
}

void FlightController::watchHorizontal(const FlightTick& tick) {
  const common::Time now = clock_.now();
  if (escape_.active() && (tick.state.horizontal_valid || escape_.flown(now))) {
    escape_.end();
    follower_.stop();
  }
  const common::Edge edge = watch_.observeHorizontal(now, tick.state.horizontal_valid, isVelocityCarried(tick));
  if (edge == common::Edge::kEntered) escape();
  if (edge != common::Edge::kLeft) return;
  // The present height, not the reference, which may be far away.
  Eigen::Vector3d here = last_state_.T_odom_body.position_m;
  here.z() = follower_.reference().position_odom_m.z();
  follower_.reset(here, bodyYaw_odom_rad());
  log_.info(clock_.now(), kFlight, "horizontal estimate is back");
}

/// The vehicle brakes, or flies away from the walls.
void FlightController::escape() {
  const bool flies = state() == FlightState::kFlying;
  const std::optional<double> length_m = flies ? escape_.start(clock_.now(), clock_.dt_s()) : std::nullopt;
  if (!length_m) {
    follower_.stop();
    return log_.warn(clock_.now(), kFlight, "horizontal estimate lost", "holding the velocity",
                     common::Concern::kPosition);
  }
  const Eigen::Vector2d velocity_m_s = Eigen::Rotation2Dd(-last_state_.T_map_odom.yaw_rad) * escape_.velocity_map_m_s();
  follower_.setVelocity({velocity_m_s.x(), velocity_m_s.y(), 0.0}, BlindEscape::kAcceleration_m_s2, bodyYaw_odom_rad());
  log_.warn(clock_.now(), kFlight, "horizontal estimate lost",
            fmt::format("flying {:.1f} m away from the walls", *length_m), common::Concern::kPosition);
}

/// The vehicle can hover for a moment without a position.
bool FlightController::isVelocityCarried(const FlightTick& tick) const {
  return velocityIsKnown() && !tick.fusion_diverged && tick.inertial_fault.empty();
}

bool FlightController::velocityIsKnown() const {
  return last_state_.velocity_covariance_m2_s2.diagonal().head<2>().maxCoeff() <
         kDampedVelocitySigma_m_s * kDampedVelocitySigma_m_s;
}

// ----------------------------------------------------------------------------------------------- the states in the air

common::Setpoint FlightController::takeOff(const FlightTick& tick) {
  if (const auto share = vertical_.spoolUpShare(clock_.now())) {
    common::Setpoint setpoint;
    setpoint.motors_on = true;
    position_.thrust().observeVoltage(tick.battery_v, clock_.dt_s());
    setpoint.thrust = *share * position_.thrust().hoverCommand();
    return setpoint;
  }
  vertical_.climb(clock_, last_state_, margin_);
  const common::Setpoint setpoint = track(tick, follower_.advance(clock_.dt_s()), !vertical_.lifted());
  if (const auto end = vertical_.takeOffEnd(clock_, last_state_, setpoint.thrust, position_.thrust()))
    transition(end->input, end->reason);
  return setpoint;
}

/// The vehicle flies behind its reference, by 6 deg of an orbit of 1.4 m at 0.5 m/s. Moved by that lag, the point is
/// seen from the reference where the vehicle sees it.
std::optional<Eigen::Vector2d> FlightController::pointToFace() const {
  // Near its end a path may ask for a heading, for which the intent waits.
  constexpr double kNearEnd_m = 0.3;
  const bool arrives = follower_.followsPath() && follower_.remaining_m() < kNearEnd_m;
  const auto& point_map_m = look_at_map_m_[0] || arrives ? look_at_map_m_[0] : look_at_map_m_[1];
  if (!point_map_m) return std::nullopt;
  const Eigen::Vector3d lag_m = follower_.reference().position_odom_m - last_state_.T_odom_body.position_m;
  return last_state_.T_map_odom.inverse() * *point_map_m + Eigen::Vector2d(lag_m.head<2>());
}

common::Setpoint FlightController::descend(const FlightTick& tick) {
  vertical_.descend(clock_, last_state_, margin_, !tick.state.horizontal_valid);
  const common::Setpoint setpoint = track(tick, follower_.advance(clock_.dt_s()));
  const auto reason = vertical_.touchedDown(clock_, last_state_, setpoint.thrust, position_.thrust());
  if (!reason) return setpoint;
  transition(FlightInput::kTouchedDown, *reason);
  common::Setpoint landed;
  landed.motors_on = true;
  return landed;
}

/// The thrust is the emergency descent's. A horizontal estimate that is still good holds the place, or its velocity.
common::Setpoint FlightController::descendInEmergency(const FlightTick& tick) {
  std::optional<VerticalMotion> carried;
  const double variance = last_state_.velocity_covariance_m2_s2(2, 2);
  if (tick.inertial_fault.empty() && !tick.fusion_diverged && isFinite(tick.state) &&
      variance < kCarriedSpeedSigma_m_s * kCarriedSpeedSigma_m_s)
    carried = VerticalMotion{last_state_.height_above_ground_m, last_state_.velocity_odom_m_s.z()};
  common::Setpoint setpoint = emergency_.tick(clock_.now(), clock_.dt_s(), position_.thrust(), carried);
  if (emergency_.touchedDown()) {
    transition(FlightInput::kTouchedDown, "emergency landing ended on the ground");
  } else if (tick.state.horizontal_valid || carried) {
    // Without a position the velocity that inertial samples carry is damped. Without a vertical error the position
    // controller leaves its hover command as it is.
    vertical_.restart(tick.state.T_odom_body.position_m.z(), tick.state.velocity_odom_m_s.z());
    const common::Setpoint held = track(tick, follower_.advance(clock_.dt_s()));
    setpoint.roll_rad = held.roll_rad;
    setpoint.pitch_rad = held.pitch_rad;
    setpoint.yaw_rate_rad_s = held.yaw_rate_rad_s;
    return setpoint;
  }
  position_.thrust().observeVoltage(tick.battery_v, clock_.dt_s());
  return setpoint;
}

common::Setpoint FlightController::track(const FlightTick& tick, const Reference& reference, bool on_ground) {
  Reference target = reference;
  if (state() != FlightState::kFlying) {
    target.position_odom_m.z() = vertical_.height_m();
    target.velocity_odom_m_s.z() = vertical_.rate_m_s();
    target.acceleration_odom_m_s2.z() = 0.0;
  }
  // The velocities of a path need its positions.
  if (!tick.state.horizontal_valid && !escape_.active()) target.velocity_odom_m_s.head<2>().setZero();
  const bool finite = isFinite(tick.state);
  if (!on_ground && finite) oscillation_.observe(tick.state.T_odom_body.rotation, clock_.dt_s());
  const ControlInput input{clock_.now(),        clock_.dt_s(), tick.state,          target, tick.acceleration_odom_m_s2,
                           horizontalFor(tick), on_ground,     oscillation_.share()};
  common::Setpoint setpoint = position_.tick(input, tick.battery_v);
  if (on_ground || !finite) return setpoint;
  setpoint = withinThrustLeft(setpoint, tick.state.T_odom_body.rotation);
  if (tick.fusion_diverged || !tick.inertial_fault.empty()) return setpoint;
  setpoint.roll_rad += tick.horizon_offset_rad.x();
  setpoint.pitch_rad += tick.horizon_offset_rad.y();
  return setpoint;
}

/// A velocity that is measured no longer would be damped beyond its end.
Horizontal FlightController::horizontalFor(const FlightTick& tick) const {
  if (tick.state.horizontal_valid) return Horizontal::kPosition;
  return isVelocityCarried(tick) ? Horizontal::kVelocity : Horizontal::kLevel;
}

// ------------------------------------------------------------------------------------------------ changes of the state

void FlightController::transition(FlightInput input, const std::string& reason) {
  const FlightState from = state();
  const auto result = machine_.apply(input);
  if (!result) return;
  enter(from, *result);
  const bool bad = input == FlightInput::kEmergency || input == FlightInput::kLand;
  if (bad) grounded_reason_ = reason;
  if (bad) return log_.warn(clock_.now(), kFlight, common::toString(*result), reason, common::Concern::kLanding);
  log_.info(clock_.now(), kFlight, common::toString(*result), reason);
}

void FlightController::enter(FlightState from, FlightState entered) {
  const Eigen::Vector3d& position_m = last_state_.T_odom_body.position_m;
  if (entered != FlightState::kLanding) escape_.end();
  switch (entered) {
    case FlightState::kTakingOff:
      grounded_reason_.clear();
      oscillation_.reset();
      follower_.reset(position_m, bodyYaw_odom_rad());
      position_.reset();
      vertical_.start(clock_.now(), position_m.z(),
                      emergency_.filter().ready() ? emergency_.filter().height_m() : position_m.z());
      return;
    case FlightState::kFlying: {
      clearance_.reset();
      Eigen::Vector3d hover = follower_.reference().position_odom_m;
      hover.z() = vertical_.goal_m();
      follower_.reset(hover, follower_.reference().yaw_odom_rad);
      return;
    }
    case FlightState::kLanding:
      // During take-off the height reference moves by itself; in flight the path moves it.
      if (from == FlightState::kFlying)
        vertical_.restart(follower_.reference().position_odom_m.z() + clearance_.lift_m(),
                          follower_.reference().velocity_odom_m_s.z());
      else
        vertical_.restart(vertical_.height_m(), vertical_.rate_m_s());
      if (!escape_.active()) follower_.stop();
      return;
    case FlightState::kEmergencyLanding:
      follower_.stop();
      startEmergencyDescent();
      return;
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanded:
      follower_.reset(position_m, bodyYaw_odom_rad());
      clearance_.reset();
      return;
  }
}

/// It brakes the last horizontal velocity that is known well enough. The trim of a vehicle that flies fast balances
/// drag, which ends with the braking.
void FlightController::startEmergencyDescent() {
  const Eigen::Rotation2Dd level_odom(-bodyYaw_odom_rad());
  const Eigen::Vector2d velocity_m_s = last_state_.velocity_odom_m_s.head<2>();
  Eigen::Vector3d trim_level_m_s2 = position_.trim_odom_m_s2();
  if (velocity_m_s.norm() < kTrimmedSpeed_m_s)
    trim_level_m_s2.head<2>() = level_odom * trim_level_m_s2.head<2>();
  else
    trim_level_m_s2.head<2>().setZero();
  const Eigen::Vector2d known_m_s = velocityIsKnown() ? level_odom * velocity_m_s : Eigen::Vector2d::Zero();
  emergency_.start(clock_.now(), vertical_.standingRaw_m(), known_m_s, trim_level_m_s2);
}

/// While the pilot flies, no setpoint of the program is flown. A take-off or a landing continues from where the pilot
/// gives the vehicle back; neither a time limit nor a touch-down is counted before that.
void FlightController::beginAtVehicle() {
  const Eigen::Vector3d& position_m = last_state_.T_odom_body.position_m;
  follower_.reset(position_m, bodyYaw_odom_rad());
  position_.reset();
  vertical_.restart(position_m.z(), 0.0);
  if (state() == FlightState::kEmergencyLanding) startEmergencyDescent();
  vertical_.skipSpoolUp(clock_.now());
}

// ------------------------------------------------------------------------------------------------------- what is known

double FlightController::bodyYaw_odom_rad() const { return common::yawOf(last_state_.T_odom_body.rotation); }

bool FlightController::stopped() const {
  if (!isAirborne(state())) return true;
  if (state() != FlightState::kFlying) return false;
  return follower_.reference().velocity_odom_m_s.norm() < kStopped_m_s &&
         last_state_.velocity_odom_m_s.norm() < kStopped_m_s;
}

double FlightController::carryingCommand() const {
  const double lift_m_s2 =
      state() == FlightState::kEmergencyLanding ? emergency_.lift_m_s2() : position_.trim_odom_m_s2().z();
  return position_.thrust().hoverCommand() * (1.0 + lift_m_s2 / common::kGravity_m_s2);
}

void FlightController::Config::describe(common::config::Fields& fields) {
  fields("climb_m_s", climb_m_s, {0.05, 3}, "Climb speed when taking off.");
  fields("descent_m_s", descent_m_s, {0.05, 3}, "Descent speed when landing.");
  fields.section("path", path, "References from paths.");
  fields.section("position", position, "Settings of the controller swiftlet, and the thrust model of all.");
  fields.section("controller", controller, "Which controller flies, and the settings of the others.");
  fields.section("clearance", clearance, "The height over what paths lead across.");
}

}  // namespace swiftlet::control
