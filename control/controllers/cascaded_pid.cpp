#include "control/controllers/cascaded_pid.hpp"

#include "common/config_fields.hpp"
#include "control/actuation.hpp"

namespace swiftlet::control {

common::Setpoint CascadedPid::tick(const ControlInput& input, ThrustModel& thrust) {
  const ControlErrors errors = errorsOf(input);
  const Eigen::Vector3d p(config_.horizontal_p_1_s2, config_.horizontal_p_1_s2, config_.vertical_p_1_s2);
  const Eigen::Vector3d i(config_.horizontal_i_1_s3, config_.horizontal_i_1_s3, config_.vertical_i_1_s3);
  const Eigen::Vector3d d(config_.horizontal_d_1_s, config_.horizontal_d_1_s, config_.vertical_d_1_s);

  // Outer loop, Saeedi III-E: a = Kp e + Ki int(e) + Kd de/dt, for x, y and the altitude.
  const Eigen::Vector3d wanted_m_s2 =
      p.cwiseProduct(errors.position_odom_m) + integral_m_s2_ + d.cwiseProduct(errors.velocity_odom_m_s);

  // The set points of the inner loops: roll, pitch and the thrust for the altitude.
  Actuation actuation =
      actuate(wanted_m_s2, errors.heading_rad, kMaxAccelerationUp_m_s2, input.on_ground, vehicle_, thrust);
  actuation.setpoint.yaw_rate_rad_s = yawRate_rad_s(input, errors.yaw_rad, config_.yaw_p_1_s, kMaxYawRate_deg_s);

  integrate(integral_m_s2_, i, errors.position_odom_m, wanted_m_s2 - actuation.given_odom_m_s2, kMaxIntegral_m_s2,
            input.dt_s);
  if (!input.on_ground) integral_m_s2_.z() -= thrust.learn(integral_m_s2_.z(), input.dt_s);
  return actuation.setpoint;
}

void CascadedPid::Config::describe(common::config::Fields& fields) {
  fields("horizontal_p_1_s2", horizontal_p_1_s2, {0, 40}, "Horizontal acceleration per position error.");
  fields("horizontal_i_1_s3", horizontal_i_1_s3, {0, 40}, "Horizontal acceleration per integrated position error.");
  fields("horizontal_d_1_s", horizontal_d_1_s, {0, 20}, "Horizontal acceleration per velocity error.");
  fields("vertical_p_1_s2", vertical_p_1_s2, {0, 40}, "Vertical acceleration per height error.");
  fields("vertical_i_1_s3", vertical_i_1_s3, {0, 40}, "Vertical acceleration per integrated height error.");
  fields("vertical_d_1_s", vertical_d_1_s, {0, 20}, "Vertical acceleration per climb speed error.");
  fields("yaw_p_1_s", yaw_p_1_s, {0, 10}, "Yaw rate per yaw error.");
}

}  // namespace swiftlet::control
