// The configuration of the fusion filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/gravity.hpp"

namespace swiftlet::perception {

struct FusionConfig {
  double history_s = 1.0;
  double gravity_m_s2 = common::kGravity_m_s2;
  double accelerometer_noise_m_s2_rthz = 0.02;
  double gyroscope_noise_rad_s_rthz = 0.002;
  double predicted_force_noise_m_s2_rthz = 0.5;
  double predicted_rate_noise_rad_s_rthz = 0.1;
  double predicted_tilt_sigma_deg = 5.0;
  double accelerometer_bias_walk_m_s3_rthz = 0.003;
  double gyroscope_bias_walk_rad_s2_rthz = 0.0005;
  double accelerometer_bias_sigma_m_s2 = 0.2;
  bool use_ahrs = true;
  double ahrs_sigma_deg = 1.0;
  double ahrs_correlation_s = 10.0;
  bool use_gravity = false;
  double gravity_sigma_m_s2 = 1.0;
  double gravity_gate_m_s2 = 0.5;
  double attitude_rate_hz = 10.0;
  bool use_drag = true;
  double drag_1_s = 0.3;
  double drag_sigma_1_s = 0.2;
  double drag_walk_1_s_rts = 0.002;
  /// Noise of the drag by draughts of 0.3 m/s that last for 2 s (Gauss-Markov), as slower motion feels them: drag *
  /// sigma * sqrt(2 tau).
  double drag_noise_m_s2_rthz = 0.1;
  double wind_sigma_m_s = 0.3;
  double wind_walk_m_s_rts = 0.001;
  double laser_yaw_sigma_deg = 0.6;
  double laser_position_sigma_m = 0.006;
  double laser_clock_sigma_s = 0.003;
  double rest_s = 0.5;
  double rest_gyroscope_sigma_rad_s = 0.05;
  double rest_accelerometer_sigma_m_s2 = 0.5;
  double zero_velocity_sigma_m_s = 0.02;
  double zero_rotation_sigma_rad_s = 0.01;
  double gate_sigma = 4.0;
  double recovery_s = 0.4;
  double pose_recovery_s = 1.5;
  int max_recoveries = 3;
  double recovery_window_s = 5.0;
  double max_speed_m_s = 8.0;
  double horizontal_timeout_s = 0.5;
  double vertical_timeout_s = 6.0;
  /// A corridor's axis is measured by the airframe's drag alone, which leaves half a metre per second in gusts
  /// (decision 018); with less the vehicle would come down in every corridor without features.
  double valid_velocity_sigma_m_s = 0.7;
  double valid_height_sigma_m = 0.25;
  double diverged_velocity_sigma_m_s = 3.0;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
