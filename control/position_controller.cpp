#include "control/position_controller.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::control {

using common::config::kPositive;
namespace {

bool finite(const common::VehicleState& state) {
  return common::isFinite(state.T_odom_body) && state.velocity_odom_m_s.allFinite();
}

Eigen::Vector2d limited(const Eigen::Vector2d& v, double most) {
  const double norm = v.norm();
  return norm > most ? Eigen::Vector2d(v * (most / norm)) : v;
}

/// The attitude whose thrust points along the wanted force; FLU, in the frame of the heading.
void setTilt(common::Setpoint& setpoint, const Eigen::Vector3d& acceleration_odom_m_s2, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const Eigen::Vector3d force(c * acceleration_odom_m_s2.x() + s * acceleration_odom_m_s2.y(),
                              -s * acceleration_odom_m_s2.x() + c * acceleration_odom_m_s2.y(),
                              kGravity_m_s2 + acceleration_odom_m_s2.z());
  // Ry(pitch) Rx(roll) e_z = (sin p cos r, -sin r, cos p cos r).
  setpoint.pitch_rad = std::atan2(force.x(), force.z());
  setpoint.roll_rad = std::atan2(-force.y(), std::hypot(force.x(), force.z()));
}

}  // namespace

PositionController::PositionController(const Config& config, const common::VehicleConfig& vehicle)
    : config_(config), vehicle_(vehicle), thrust_(config.thrust, vehicle) {}

void PositionController::reset() {
  integral_m_s2_.setZero();
  delayed_.reset();
}

common::Setpoint PositionController::tick(common::Time now, double dt_s, const common::VehicleState& state,
                                          const Reference& reference, double battery_v, Horizontal horizontal,
                                          bool on_ground) {
  common::Setpoint setpoint;
  setpoint.stamp = now;
  setpoint.motors_on = true;
  thrust_.observeVoltage(battery_v, dt_s);
  if (!finite(state)) {
    setpoint.thrust = thrust_.hoverCommand();
    return setpoint;
  }
  if (on_ground) horizontal = Horizontal::kLevel;
  if (horizontal == Horizontal::kPosition)
    delay(reference, dt_s);
  else
    delayed_.reset();
  const Eigen::Vector3d missing_m_s = missingVelocity(state, reference, horizontal);
  const Eigen::Vector3d gain_1_s(config_.horizontal_v_1_s, config_.horizontal_v_1_s, config_.vertical_v_1_s);
  Eigen::Vector3d wanted_m_s2 = gain_1_s.cwiseProduct(missing_m_s) + integral_m_s2_;
  wanted_m_s2.z() += reference.acceleration_odom_m_s2.z();
  if (horizontal == Horizontal::kPosition) wanted_m_s2.head<2>() += reference.acceleration_odom_m_s2.head<2>();

  Eigen::Vector3d given_m_s2 = wanted_m_s2;
  // More than the motors can give would only wind up the integral. A vehicle that still stands may be much weaker than
  // is known, so that it is given whatever lifts it.
  const double available_m_s2 = std::max(0.0, kGravity_m_s2 * (thrust_.margin() - 1.0));
  const double most_up_m_s2 = on_ground ? available_m_s2 : std::min(available_m_s2, config_.max_acceleration_up_m_s2);
  given_m_s2.z() = std::clamp(wanted_m_s2.z(), -config_.max_acceleration_up_m_s2, most_up_m_s2);
  given_m_s2.head<2>() =
      limited(wanted_m_s2.head<2>(), std::tan(greatestTilt_rad()) * (kGravity_m_s2 + given_m_s2.z()));
  if (on_ground) given_m_s2.head<2>().setZero();

  const double yaw_rad = common::yawOf(state.T_odom_body.rotation);
  setTilt(setpoint, given_m_s2, yaw_rad);
  const double cos_tilt = std::cos(setpoint.roll_rad) * std::cos(setpoint.pitch_rad);
  setpoint.thrust = thrust_.commandFor(given_m_s2.z(), cos_tilt);
  if (horizontal == Horizontal::kPosition) {
    const double most_rad_s = config_.max_yaw_rate_deg_s * common::kRadPerDeg;
    setpoint.yaw_rate_rad_s =
        std::clamp(reference.yaw_rate_rad_s + config_.yaw_p_1_s * common::wrapAngle(reference.yaw_odom_rad - yaw_rad),
                   -most_rad_s, most_rad_s);
  }
  integrate(missing_m_s, wanted_m_s2, given_m_s2, dt_s);
  if (!on_ground) integral_m_s2_.z() -= thrust_.learn(integral_m_s2_.z(), dt_s);
  return setpoint;
}

/// A tilt that the thrust could not carry would cost height, so 3 % of the weight is kept for the height. The least
/// tilt, 3 degrees, accelerates by 0.5 m/s2: enough to hold against a light wind while the vehicle sinks.
double PositionController::greatestTilt_rad() const {
  constexpr double kLeast_rad = 3.0 * common::kRadPerDeg, kKeptForHeight = 1.03;
  const double carried_rad = std::acos(std::clamp(kKeptForHeight / thrust_.margin(), 0.0, 1.0));
  return std::min(vehicle_.max_tilt_deg * common::kRadPerDeg, std::max(kLeast_rad, carried_rad));
}

Eigen::Vector3d PositionController::missingVelocity(const common::VehicleState& state, const Reference& reference,
                                                    Horizontal horizontal) const {
  Eigen::Vector3d missing_m_s = Eigen::Vector3d::Zero();
  const double climb_error_m = reference.position_odom_m.z() - state.T_odom_body.position_m.z();
  const double climb_velocity_error_m_s = reference.velocity_odom_m_s.z() - state.velocity_odom_m_s.z();
  missing_m_s.z() = climb_velocity_error_m_s +
                    std::clamp(config_.vertical_p_1_s * (climb_error_m + config_.latency_s * climb_velocity_error_m_s),
                               -config_.max_climb_m_s, config_.max_climb_m_s);
  if (horizontal == Horizontal::kLevel) return missing_m_s;

  const Eigen::Vector2d velocity_m_s = state.velocity_odom_m_s.head<2>();
  if (!delayed_) {
    missing_m_s.head<2>() = -velocity_m_s;
    return missing_m_s;
  }
  const Eigen::Vector2d position_error_m = delayed_->position_odom_m - state.T_odom_body.position_m.head<2>();
  const Eigen::Vector2d correction = limited(config_.horizontal_p_1_s * position_error_m, config_.max_correction_m_s);
  missing_m_s.head<2>() = limited(delayed_->velocity_odom_m_s + correction, config_.max_speed_m_s) - velocity_m_s;
  return missing_m_s;
}

/// The reference's acceleration is fed forward at once, but the vehicle takes it up only as its attitude follows. The
/// errors are those from the reference behind the same lag; otherwise each change of speed would look like an error.
void PositionController::delay(const Reference& reference, double dt_s) {
  constexpr double kJump_m = 0.3;  // A reference that was placed anew did not get there by flying.
  const Eigen::Vector2d position_m = reference.position_odom_m.head<2>();
  const Eigen::Vector2d velocity_m_s = reference.velocity_odom_m_s.head<2>();
  const double lag_s = config_.attitude_lag_s;
  if (!delayed_ || lag_s <= 0.0 ||
      (delayed_->position_odom_m + lag_s * delayed_->velocity_odom_m_s - position_m).norm() > kJump_m)
    delayed_ = Delayed{position_m, velocity_m_s};
  if (lag_s <= 0.0) return;
  const double share = 1.0 - std::exp(-dt_s / lag_s);
  delayed_->position_odom_m += share * (position_m - delayed_->position_odom_m);
  delayed_->velocity_odom_m_s += share * (velocity_m_s - delayed_->velocity_odom_m_s);
}

void PositionController::integrate(const Eigen::Vector3d& missing_m_s, const Eigen::Vector3d& wanted_m_s2,
                                   const Eigen::Vector3d& given_m_s2, double dt_s) {
  const Eigen::Vector3d gain_1_s2(config_.horizontal_i_1_s2, config_.horizontal_i_1_s2, config_.vertical_i_1_s2);
  for (int axis = 0; axis < 3; ++axis) {
    const double refused_m_s2 = wanted_m_s2[axis] - given_m_s2[axis];
    // The integral must not grow when the vehicle cannot give more.
    if (refused_m_s2 * missing_m_s[axis] > 1e-9) continue;
    integral_m_s2_[axis] = std::clamp(integral_m_s2_[axis] + dt_s * gain_1_s2[axis] * missing_m_s[axis],
                                      -config_.max_integral_m_s2, config_.max_integral_m_s2);
  }
}

void PositionController::Config::describe(common::config::Fields& fields) {
  fields("horizontal_p_1_s", horizontal_p_1_s, {0, 10}, "Horizontal velocity per position error.");
  fields("horizontal_v_1_s", horizontal_v_1_s, {0, 20}, "Horizontal acceleration per velocity error.");
  fields("horizontal_i_1_s2", horizontal_i_1_s2, {0, 20}, "Horizontal acceleration per integrated velocity error.");
  fields("vertical_p_1_s", vertical_p_1_s, {0, 10}, "Climb speed per height error.");
  fields("vertical_v_1_s", vertical_v_1_s, {0, 20}, "Vertical acceleration per climb speed error.");
  fields("vertical_i_1_s2", vertical_i_1_s2, {0, 20}, "Vertical acceleration per integrated climb speed error.");
  fields("yaw_p_1_s", yaw_p_1_s, {0, 10}, "Yaw rate per yaw error.");
  fields("max_correction_m_s", max_correction_m_s, kPositive,
         "Greatest velocity that a position error adds to the reference's.");
  fields("max_speed_m_s", max_speed_m_s, kPositive, "Greatest horizontal speed of reference and correction together.");
  fields("max_climb_m_s", max_climb_m_s, kPositive,
         "Greatest climb speed that a height error adds to the reference's.");
  fields("max_acceleration_up_m_s2", max_acceleration_up_m_s2, {0.1, 9}, "Greatest vertical acceleration.");
  fields("max_integral_m_s2", max_integral_m_s2, {0, 9}, "Greatest integral part of the acceleration.");
  fields("max_yaw_rate_deg_s", max_yaw_rate_deg_s, kPositive, "Greatest yaw rate.");
  fields("latency_s", latency_s, {0, 0.5},
         "Time from measurement to command, by which the vertical state is predicted.");
  fields(
      "attitude_lag_s", attitude_lag_s, {0, 0.5},
      "Time the attitude takes to follow a command, by which the reference is delayed before the vehicle is compared "
      "with it.");
  fields.section("thrust", thrust, "Thrust by battery voltage.");
}

}  // namespace swiftlet::control
