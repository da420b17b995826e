#include "simulation/autopilot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/sensors/inertial_unit.hpp"

namespace swiftlet::simulation {
namespace {

using Eigen::Vector3d;

/// Below this thrust command the vehicle stands, and the integral is cleared, as PX4 and ArduPilot do on the ground.
constexpr double kThrustOnGround = 0.2;
/// Anti-windup: only small rate errors are integrated, and the integral is limited.
constexpr double kSmallRateError_rad_s = 0.3;
constexpr double kMostIntegral_rad = 0.3;

double finiteOr(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

void AutopilotConfig::describe(common::config::Fields& fields) {
  fields("attitude_gain_1_s", attitude_gain_1_s, {0.1, 100}, "Rate per radian of roll or pitch error.");
  fields("max_rate_rad_s", max_rate_rad_s, {0.1, 50}, "Greatest roll and pitch rate.");
  fields("max_yaw_rate_rad_s", max_yaw_rate_rad_s, {0.1, 50}, "Greatest yaw rate.");
  fields("rate_gain_1_s", rate_gain_1_s, {0.1, 500}, "Angular acceleration per roll or pitch rate error.");
  fields("yaw_rate_gain_1_s", yaw_rate_gain_1_s, {0.1, 500}, "Angular acceleration per yaw rate error.");
  fields("rate_integral_1_s2", rate_integral_1_s2, {0, 500},
         "Angular acceleration per integrated rate error, which removes a constant lean.");
  fields("link_timeout_s", link_timeout_s, {0.05, 10},
         "Without a new setpoint for this long the vehicle levels and descends.");
  fields("failsafe_thrust_share", failsafe_thrust_share, {0.5, 1},
         "Thrust of the descent without setpoints, as a share of the weight.");
  fields("tilt_share", tilt_share, {0.5, 1.5}, "Angle that the autopilot takes, over the commanded one.");
  fields("tilt_expo", tilt_expo, {0, 0.9}, "Share of the third power in the curve from command to angle.");
  fields.choice("mixing", mixing, {"clamp_each", "attitude_first"},
                "How motors at their limit are shared: each clamped, or roll and pitch first, then thrust, yaw last.");
  fields("program_share", program_share, {0, 1},
         "Share of its range by which the program's setpoints may move each stick of a pilot who flies; 0: the pilot "
         "flies alone.");
}

Autopilot::Autopilot(const common::VehicleConfig& vehicle, const QuadrotorConfig& airframe,
                     const AutopilotConfig& config)
    : vehicle_(vehicle), airframe_(scaledTo(vehicle, airframe)), config_(config) {}

void Autopilot::receive(const common::Setpoint& setpoint, common::Time arrived) {
  setpoint_ = program_ = setpoint;
  received_ = program_received_ = arrived;
}

void Autopilot::fly(const common::Setpoint& sticks, common::Time now) {
  setpoint_ = movedByProgram(sticks, now);
  received_ = now;
}

common::Setpoint Autopilot::movedByProgram(const common::Setpoint& sticks, common::Time now) const {
  const common::Setpoint& program = program_;
  const bool finite = std::isfinite(program.roll_rad) && std::isfinite(program.pitch_rad) &&
                      std::isfinite(program.yaw_rate_rad_s) && std::isfinite(program.thrust);
  const bool fresh = (now - program_received_).seconds() <= config_.link_timeout_s;
  if (config_.program_share == 0.0 || !sticks.motors_on || !program.motors_on || !finite || !fresh) return sticks;
  const auto moved = [this](double stick, double wanted, double range) {
    const double most = config_.program_share * range;
    return stick + std::clamp(wanted - stick, -most, most);
  };
  const double max_tilt_rad = vehicle_.max_tilt_deg * std::numbers::pi / 180.0;
  common::Setpoint both = sticks;
  both.roll_rad = moved(sticks.roll_rad, program.roll_rad, max_tilt_rad);
  both.pitch_rad = moved(sticks.pitch_rad, program.pitch_rad, max_tilt_rad);
  both.yaw_rate_rad_s = moved(sticks.yaw_rate_rad_s, program.yaw_rate_rad_s, config_.max_yaw_rate_rad_s);
  both.thrust = moved(sticks.thrust, program.thrust, 1.0);
  return both;
}

bool Autopilot::linkLost(common::Time now) const { return (now - received_).seconds() > config_.link_timeout_s; }

/// The setpoint within the vehicle's limits, or the autopilot's own setpoint if the link is lost.
common::Setpoint Autopilot::effective(common::Time now, const AttitudeMeasurement& measured) const {
  common::Setpoint setpoint = setpoint_;
  if (setpoint.motors_on && linkLost(now)) {
    // The autopilot's own voltmeter shows how much throttle makes up for the falling thrust.
    const double sag = measured.battery_voltage_v / vehicle_.battery_full_v;
    setpoint.roll_rad = setpoint.pitch_rad = setpoint.yaw_rate_rad_s = 0.0;
    setpoint.thrust = config_.failsafe_thrust_share * vehicle_.mass_kg * common::kGravity_m_s2 /
                      (vehicle_.max_thrust_n * std::max(0.25, sag * sag));
  }
  const double max_tilt_rad = vehicle_.max_tilt_deg * std::numbers::pi / 180.0;
  setpoint.roll_rad = tiltFor(std::clamp(finiteOr(setpoint.roll_rad, 0.0), -max_tilt_rad, max_tilt_rad));
  setpoint.pitch_rad = tiltFor(std::clamp(finiteOr(setpoint.pitch_rad, 0.0), -max_tilt_rad, max_tilt_rad));
  setpoint.yaw_rate_rad_s =
      std::clamp(finiteOr(setpoint.yaw_rate_rad_s, 0.0), -config_.max_yaw_rate_rad_s, config_.max_yaw_rate_rad_s);
  setpoint.thrust = std::clamp(finiteOr(setpoint.thrust, 0.0), 0.0, 1.0);
  return setpoint;
}

/// The angle that the autopilot takes for a command: a share of it, bent as the sticks of a remote control are.
double Autopilot::tiltFor(double command_rad) const {
  if (config_.tilt_share == 1.0 && config_.tilt_expo == 0.0) return command_rad;
  const double most_rad = vehicle_.max_tilt_deg * std::numbers::pi / 180.0, share = command_rad / most_rad;
  return config_.tilt_share * most_rad *
         ((1.0 - config_.tilt_expo) * share + config_.tilt_expo * share * share * share);
}

/// The integral removes a constant lean. It does not wind up during a step or against the floor.
void Autopilot::integrate(const Vector3d& rate_error, double thrust, double step_s) {
  if (thrust < kThrustOnGround) rate_integral_rad_.setZero();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(rate_error[axis]) < kSmallRateError_rad_s)
      rate_integral_rad_[axis] =
          std::clamp(rate_integral_rad_[axis] + step_s * rate_error[axis], -kMostIntegral_rad, kMostIntegral_rad);
}

std::array<double, 4> Autopilot::tick(common::Time now, const AttitudeMeasurement& measured, double step_s) {
  const common::Setpoint setpoint = effective(now, measured);
  if (!setpoint.motors_on) {
    rate_integral_rad_.setZero();
    return {};
  }

  // Attitude: roll and pitch error of the AHRS; the yaw rate is the gyro's.
  const common::RollPitchYaw angles = common::rollPitchYaw(measured.rotation_ahrs_body);
  const auto rateFor = [this](double error_rad) {
    return std::clamp(config_.attitude_gain_1_s * error_rad, -config_.max_rate_rad_s, config_.max_rate_rad_s);
  };
  const double roll_rate = rateFor(setpoint.roll_rad - angles.roll_rad);
  const double pitch_rate = rateFor(setpoint.pitch_rad - angles.pitch_rad);
  // Euler angle rates to body rates.
  const double sin_roll = std::sin(angles.roll_rad), cos_roll = std::cos(angles.roll_rad);
  const double sin_pitch = std::sin(angles.pitch_rad), cos_pitch = std::cos(angles.pitch_rad);
  const Vector3d wanted_rate(roll_rate - sin_pitch * setpoint.yaw_rate_rad_s,
                             cos_roll * pitch_rate + sin_roll * cos_pitch * setpoint.yaw_rate_rad_s,
                             -sin_roll * pitch_rate + cos_roll * cos_pitch * setpoint.yaw_rate_rad_s);

  const Vector3d error = wanted_rate - measured.angular_velocity_body_rad_s;
  integrate(error, setpoint.thrust, step_s);
  const Vector3d gain(config_.rate_gain_1_s, config_.rate_gain_1_s, config_.yaw_rate_gain_1_s);
  const Vector3d acceleration = gain.cwiseProduct(error) + config_.rate_integral_1_s2 * rate_integral_rad_;

  // Torques around the collective, as shares of the full thrust of one motor.
  const double motor_n = 0.25 * vehicle_.max_thrust_n;
  const double lever_m = airframe_.arm_m / std::sqrt(2.0);
  const double roll = airframe_.inertia_xx_kg_m2 * acceleration.x() / (4.0 * lever_m * motor_n);
  const double pitch = airframe_.inertia_yy_kg_m2 * acceleration.y() / (4.0 * lever_m * motor_n);
  const double yaw = std::clamp(
      airframe_.inertia_zz_kg_m2 * acceleration.z() / (4.0 * airframe_.torque_per_thrust_m * motor_n), -0.15, 0.15);
  return mixed(setpoint.thrust, roll, pitch, yaw);
}

std::array<double, 4> Autopilot::mixed(double thrust, double roll, double pitch, double yaw) const {
  if (config_.mixing == Mixing::kAttitudeFirst) {
    // The yaw torque takes what roll and pitch leave; then the thrust is lowered until the strongest motor can do it.
    // It is never raised, so that a vehicle that lands does not hop.
    const double attitude = std::min(std::abs(roll) + std::abs(pitch), 0.5);
    const double left_for_yaw = std::max(0.0, std::min(0.5, 1.0 - thrust) - attitude);
    yaw = std::clamp(yaw, -left_for_yaw, left_for_yaw);
    thrust = std::min(thrust, 1.0 - attitude - std::abs(yaw));
  }
  return {std::clamp(thrust + roll - pitch + yaw, 0.0, 1.0), std::clamp(thrust - roll - pitch - yaw, 0.0, 1.0),
          std::clamp(thrust - roll + pitch + yaw, 0.0, 1.0), std::clamp(thrust + roll + pitch - yaw, 0.0, 1.0)};
}

}  // namespace swiftlet::simulation
