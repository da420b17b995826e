#include "control/position_controller.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "control/actuation.hpp"
#include "control/control_errors.hpp"

namespace swiftlet::control {

using common::config::kPositive;
namespace {

/// Greatest velocity that a position error adds to the reference's.
constexpr double kMaxCorrection_m_s = 1.0;
constexpr double kMaxClimb_m_s = 1.0;  ///< Greatest climb speed that a height error adds to the reference's.
/// Time from measurement to command, by which the vertical state is predicted.
constexpr double kLatency_s = 0.03;

}  // namespace

PositionController::PositionController(const Config& config, const common::VehicleConfig& vehicle)
    : config_(config), vehicle_(vehicle) {}

void PositionController::reset() {
  integral_m_s2_.setZero();
  trim_yaw_rad_.reset();
  lagged_.reset();
}

void PositionController::setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel&) {
  integral_m_s2_ = trim_odom_m_s2.cwiseMax(-kMaxIntegral_m_s2).cwiseMin(kMaxIntegral_m_s2);
  trim_yaw_rad_.reset();
}

common::Setpoint PositionController::tick(const ControlInput& input, ThrustModel& thrust) {
  const auto& [now, dt_s, state, reference, measured_m_s2, horizontal, on_ground, share] = input;
  if (horizontal == Horizontal::kPosition)
    lagged_.advance(reference, config_.attitude_lag_s, dt_s);
  else
    lagged_.reset();
  const double yaw_rad = common::yawOf(state.T_odom_body.rotation);
  turnTrim(yaw_rad);
  const Eigen::Vector3d missing_m_s = missingVelocity(state, reference, horizontal, share);
  const Eigen::Vector3d gain_1_s(share * config_.horizontal_v_1_s, share * config_.horizontal_v_1_s,
                                 config_.vertical_v_1_s);
  Eigen::Vector3d wanted_m_s2 = gain_1_s.cwiseProduct(missing_m_s) + integral_m_s2_;
  wanted_m_s2.z() += reference.acceleration_odom_m_s2.z();
  if (horizontal == Horizontal::kPosition) wanted_m_s2.head<2>() += reference.acceleration_odom_m_s2.head<2>();

  Actuation actuation = actuate(wanted_m_s2, yaw_rad, kMaxAccelerationUp_m_s2, on_ground, vehicle_, thrust);
  actuation.setpoint.yaw_rate_rad_s = yawRate_rad_s(input, common::wrapAngle(reference.yaw_odom_rad - yaw_rad),
                                                    config_.yaw_p_1_s, config_.max_yaw_rate_deg_s);
  const Eigen::Vector3d rate_1_s2(config_.horizontal_i_1_s2, config_.horizontal_i_1_s2, config_.vertical_i_1_s2);
  integrate(integral_m_s2_, rate_1_s2, missing_m_s, wanted_m_s2 - actuation.given_odom_m_s2, kMaxIntegral_m_s2, dt_s);
  if (!on_ground) integral_m_s2_.z() -= thrust.learn(integral_m_s2_.z(), dt_s);
  return actuation.setpoint;
}

/// Most of what the trim compensates turns with the vehicle: an attitude that is read with a lean, a weak motor, the
/// drag of flying ahead.
void PositionController::turnTrim(double yaw_rad) {
  if (trim_yaw_rad_)
    integral_m_s2_.head<2>() = Eigen::Rotation2Dd(yaw_rad - *trim_yaw_rad_) * Eigen::Vector2d(integral_m_s2_.head<2>());
  trim_yaw_rad_ = yaw_rad;
}

Eigen::Vector3d PositionController::missingVelocity(const common::VehicleState& state, const Reference& reference,
                                                    Horizontal horizontal, double share) const {
  Eigen::Vector3d missing_m_s = Eigen::Vector3d::Zero();
  const double climb_error_m = reference.position_odom_m.z() - state.T_odom_body.position_m.z();
  const double climb_velocity_error_m_s = reference.velocity_odom_m_s.z() - state.velocity_odom_m_s.z();
  missing_m_s.z() = climb_velocity_error_m_s +
                    std::clamp(config_.vertical_p_1_s * (climb_error_m + kLatency_s * climb_velocity_error_m_s),
                               -kMaxClimb_m_s, kMaxClimb_m_s);
  if (horizontal == Horizontal::kLevel) return missing_m_s;

  const Eigen::Vector2d velocity_m_s = state.velocity_odom_m_s.head<2>();
  if (!lagged_.point()) {
    missing_m_s.head<2>() = reference.velocity_odom_m_s.head<2>() - velocity_m_s;
    return missing_m_s;
  }
  const Eigen::Vector2d position_error_m = lagged_.point()->position_odom_m - state.T_odom_body.position_m.head<2>();
  const Eigen::Vector2d correction = limited(share * config_.horizontal_p_1_s * position_error_m, kMaxCorrection_m_s);
  // A reference that is faster, in a mode for that, keeps its speed.
  const Eigen::Vector2d& wanted_m_s = lagged_.point()->velocity_odom_m_s;
  missing_m_s.head<2>() =
      limited(wanted_m_s + correction, std::max(config_.max_speed_m_s, wanted_m_s.norm())) - velocity_m_s;
  return missing_m_s;
}

void PositionController::Config::describe(common::config::Fields& fields) {
  fields("horizontal_p_1_s", horizontal_p_1_s, {0, 10}, "Horizontal velocity per position error.");
  fields("horizontal_v_1_s", horizontal_v_1_s, {0, 20}, "Horizontal acceleration per velocity error.");
  fields("horizontal_i_1_s2", horizontal_i_1_s2, {0, 20}, "Horizontal acceleration per integrated velocity error.");
  fields("vertical_p_1_s", vertical_p_1_s, {0, 10}, "Climb speed per height error.");
  fields("vertical_v_1_s", vertical_v_1_s, {0, 20}, "Vertical acceleration per climb speed error.");
  fields("vertical_i_1_s2", vertical_i_1_s2, {0, 20}, "Vertical acceleration per integrated climb speed error.");
  fields("yaw_p_1_s", yaw_p_1_s, {0, 10}, "Yaw rate per yaw error.");
  fields("max_speed_m_s", max_speed_m_s, kPositive,
         "Greatest horizontal speed of reference and correction together, where the reference alone is not faster.");
  fields("max_yaw_rate_deg_s", max_yaw_rate_deg_s, kPositive, "Greatest yaw rate.");
  fields(
      "attitude_lag_s", attitude_lag_s, {0, 0.5},
      "Time the attitude takes to follow a command, by which the reference is delayed before the vehicle is compared "
      "with it.");
  fields.section("thrust", thrust, "Thrust by battery voltage.");
}

}  // namespace swiftlet::control
