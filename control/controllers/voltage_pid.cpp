#include "control/controllers/voltage_pid.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "control/actuation.hpp"

namespace swiftlet::control {

using common::kRadPerDeg;

VoltagePid::VoltagePid(const Config& config, const common::VehicleConfig& vehicle, const VehicleModel* model)
    : config_(config), vehicle_(vehicle) {
  if (model == nullptr) return;
  bench_pitch_ = model->bench_pitch;
  bench_roll_ = model->bench_roll;
}

void VoltagePid::reset() { integral_.setZero(); }

common::Setpoint VoltagePid::tick(const ControlInput& input, ThrustModel& thrust) {
  const ControlErrors errors = errorsOf(input);
  const double kp = config_.horizontal_p_deg_m * kRadPerDeg, kd = config_.horizontal_d_deg_s_m * kRadPerDeg;
  common::Setpoint setpoint;

  // Grzonka 2012, equation 3: u = Kp (x - x*) + Ki e + Kd v, for x and y. Its signs are those of the autopilot; the
  // velocity is taken relative to the reference's, which is zero in the paper's hover.
  const Eigen::Vector2d tilt_odom_rad =
      kp * errors.position_odom_m.head<2>() + integral_.head<2>() + kd * errors.velocity_odom_m_s.head<2>();
  const Eigen::Vector2d given_rad = input.on_ground ? Eigen::Vector2d(Eigen::Vector2d::Zero())
                                                    : limited(tilt_odom_rad, greatestTilt_rad(vehicle_, thrust));
  const Eigen::Vector2d tilt_level_rad = Eigen::Rotation2Dd(-errors.heading_rad) * given_rad;
  setpoint.pitch_rad = commandFor(tilt_level_rad.x(), bench_pitch_);
  setpoint.roll_rad = commandFor(-tilt_level_rad.y(), bench_roll_);

  // Equation 4: u = Kp (psi - psi*).
  setpoint.yaw_rate_rad_s = yawRate_rad_s(input, errors.yaw_rad, config_.yaw_p_1_s, kMaxYawRate_deg_s);

  // Equation 5: u = C(U) + Kp (z - z*) + Ki e_z + Kd v_z. Grzonka 2009, equation 9, has no C(U).
  const double wanted = thrust.hoverCommand() + config_.vertical_p_1_m * errors.position_odom_m.z() + integral_.z() +
                        config_.vertical_d_s_m * errors.velocity_odom_m_s.z();
  setpoint.thrust = thrust.clamped(wanted);

  Eigen::Vector3d refused;
  refused << tilt_odom_rad - given_rad, wanted - setpoint.thrust;
  integrate(errors, refused, input.dt_s);
  if (!input.on_ground) learnOffset(thrust, input.dt_s);
  return setpoint;
}

void VoltagePid::integrate(const ControlErrors& errors, const Eigen::Vector3d& refused, double dt_s) {
  const double horizontal = config_.horizontal_i_deg_m_s * kRadPerDeg;
  control::integrate(integral_, {horizontal, horizontal, config_.vertical_i_1_m_s}, errors.position_odom_m, refused,
                     kMaxIntegral_m_s2 / common::kGravity_m_s2, dt_s);
}

void VoltagePid::learnOffset(ThrustModel& thrust, double dt_s) {
  const double offset = thrust.hoverCommand();
  thrust.learn(common::kGravity_m_s2 * integral_.z() / offset, dt_s);
  integral_.z() -= thrust.hoverCommand() - offset;
}

Eigen::Vector3d VoltagePid::trim_odom_m_s2(const ThrustModel& thrust) const {
  return common::kGravity_m_s2 * Eigen::Vector3d(integral_.x(), integral_.y(), integral_.z() / thrust.hoverCommand());
}

void VoltagePid::setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) {
  integral_ = trim_odom_m_s2 / common::kGravity_m_s2;
  integral_.z() *= thrust.hoverCommand();
}

void VoltagePid::Config::describe(common::config::Fields& fields) {
  fields("horizontal_p_deg_m", horizontal_p_deg_m, {0, 200}, "Tilt per position error.");
  fields("horizontal_i_deg_m_s", horizontal_i_deg_m_s, {0, 200}, "Tilt per integrated position error.");
  fields("horizontal_d_deg_s_m", horizontal_d_deg_s_m, {0, 200}, "Tilt per velocity error.");
  fields("vertical_p_1_m", vertical_p_1_m, {0, 10}, "Share of the full thrust per height error.");
  fields("vertical_i_1_m_s", vertical_i_1_m_s, {0, 10}, "Share of the full thrust per integrated height error.");
  fields("vertical_d_s_m", vertical_d_s_m, {0, 10}, "Share of the full thrust per climb speed error.");
  fields("yaw_p_1_s", yaw_p_1_s, {0, 10}, "Yaw rate per yaw error.");
}

}  // namespace swiftlet::control
