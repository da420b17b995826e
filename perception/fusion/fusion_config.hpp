// The configuration of the fusion filter.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"

namespace swiftlet::perception {

struct FusionConfig {
  double history_s = 1.0;  ///< How late a measurement may come.
  double gravity_m_s2 = 9.81;
  // IMU, as continuous densities.
  double accelerometer_noise_m_s2_rthz = 0.02;
  double gyroscope_noise_rad_s_rthz = 0.002;
  double accelerometer_bias_walk_m_s3_rthz = 0.003;
  double gyroscope_bias_walk_rad_s2_rthz = 0.0005;
  double accelerometer_bias_sigma_m_s2 = 0.2;  ///< At the start.
  // Attitude of the vehicle's own AHRS; roll and pitch only.
  bool use_ahrs = true;
  double ahrs_sigma_deg = 1.0;
  double ahrs_correlation_s = 10.0;  ///< The error keeps this long; the noise is widened to match.
  // Gravity vector as pseudo-measurement of roll and pitch (for vehicles without an AHRS).
  bool use_gravity = false;
  double gravity_sigma_m_s2 = 1.0;  ///< What the vehicle's own acceleration adds.
  double attitude_rate_hz = 10.0;   ///< Of either of them, of the drag, and of what is known at rest.
  // Drag as a measurement of the velocity through the air: what holds the velocity where the laser does not. Nobody
  // gives the coefficient; it is learned in flight while the laser sees all directions, and the wind with it.
  bool use_drag = true;
  double drag_1_s = 0.3;  ///< At the start: of small quadrotors 0.1 to 0.5.
  double drag_sigma_1_s = 0.2;
  double drag_walk_1_s_rts = 0.002;    ///< It changes with the speed, the battery, the height.
  double drag_noise_m_s2_rthz = 0.02;  ///< Of the accelerometer, and what is not drag.
  double wind_sigma_m_s = 0.3;
  double wind_walk_m_s_rts = 0.001;
  // At rest on the ground.
  double rest_s = 0.5;                       ///< IMU stretch that initialize() averages.
  double rest_gyroscope_sigma_rad_s = 0.05;  ///< More spread than this: it is moving.
  double rest_accelerometer_sigma_m_s2 = 0.5;
  double zero_velocity_sigma_m_s = 0.02;
  double zero_rotation_sigma_rad_s = 0.01;
  // Gates, recovery, divergence.
  double gate_sigma = 4.0;  ///< Per degree of freedom, roughly.
  double recovery_s = 0.4;  ///< A gate closed for this long is opened by force.
  int max_recoveries = 3;   ///< More within `recovery_window_s`: diverged.
  double recovery_window_s = 5.0;
  double max_speed_m_s = 8.0;              ///< A faster estimate is a divergence.
  double horizontal_timeout_s = 0.5;       ///< Without a relative pose: degraded.
  double vertical_timeout_s = 6.0;         ///< Without a height: degraded. Over slopes there is none.
  double valid_velocity_sigma_m_s = 0.35;  ///< Up to here the velocity may be used for control.
  double valid_height_sigma_m = 0.25;
  double diverged_velocity_sigma_m_s = 3.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
