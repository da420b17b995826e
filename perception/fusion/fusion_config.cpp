#include "perception/fusion/fusion_config.hpp"

#include "common/validation.hpp"

namespace swiftlet::perception {

void FusionConfig::describe(common::config::Fields& fields) {
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

std::vector<std::string> FusionConfig::validate() const {
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
