// The configuration of the fusion filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/gravity.hpp"

namespace swiftlet::perception {

struct FusionConfig {
  static constexpr double history_s = 1.0;      ///< Greatest delay with which a measurement may come.
  double gravity_m_s2 = common::kGravity_m_s2;  ///< Magnitude of gravity.
  double accelerometer_noise_m_s2_rthz = 0.02;
  double gyroscope_noise_rad_s_rthz = 0.002;
  static constexpr double predicted_force_noise_m_s2_rthz =
      0.5;  ///< Noise density of a specific force that the thrust predicts: 5 % of gravity for a second.
  static constexpr double predicted_rate_noise_rad_s_rthz =
      0.1;  ///< Noise density of a rate of rotation that the setpoints predict: 2 deg after a tenth of a second.
  static constexpr double predicted_tilt_sigma_deg =
      5.0;  ///< Standard deviation of a roll or pitch that the setpoints predict, each time that attitudes are used.
  double accelerometer_bias_walk_m_s3_rthz = 0.003;
  double gyroscope_bias_walk_rad_s2_rthz = 0.0005;
  double accelerometer_bias_sigma_m_s2 = 0.2;  ///< Standard deviation of the accelerometer's bias at the start.
  bool use_ahrs = true;
  double ahrs_sigma_deg = 1.0;
  static constexpr double ahrs_correlation_s =
      10.0;  ///< Correlation time of the AHRS's error; the noise is widened to match.
  bool use_gravity = false;
  static constexpr double gravity_sigma_m_s2 =
      1.0;  ///< Standard deviation of the specific force from gravity, by the vehicle's own acceleration.
  static constexpr double gravity_gate_m_s2 =
      0.5;  ///< A specific force whose size differs from gravity by more is not taken for it.
  static constexpr double attitude_rate_hz =
      10.0;              ///< Rate at which AHRS, gravity, drag and what is known at rest are used.
  bool use_drag = true;  ///< Whether the specific force along the body's x and y is taken for drag, which measures the
                         ///< velocity through the air where the laser does not.
  double drag_1_s = 0.3;
  static constexpr double drag_sigma_1_s = 0.2;  ///< Standard deviation of drag_1_s at the start.
  static constexpr double drag_walk_1_s_rts =
      0.002;  ///< Random walk of the drag, which changes with speed, battery and height.
  /// Noise of the drag by draughts of 0.3 m/s that last for 2 s (Gauss-Markov), as they act on slower motion: drag *
  /// sigma * sqrt(2 tau).
  double drag_noise_m_s2_rthz = 0.1;
  static constexpr double wind_sigma_m_s = 0.3;  ///< Standard deviation of each component of the wind at the start.
  static constexpr double wind_walk_m_s_rts = 0.001;  ///< Random walk of each component of the wind.
  double laser_yaw_sigma_deg =
      0.6;  ///< Standard deviation of the yaw by which the laser is mounted otherwise than its data sheet says.
  double laser_position_sigma_m =
      0.006;  ///< Standard deviation of the x and y by which the laser is mounted otherwise than its data sheet says.
  double laser_clock_sigma_s = 0.003;    ///< Standard deviation of the time by which the laser's stamps are off.
  static constexpr double rest_s = 0.5;  ///< Duration of the samples at rest that the start averages.
  static constexpr double rest_gyroscope_sigma_rad_s =
      0.05;  ///< With more spread of the gyroscope than this the vehicle is moving.
  static constexpr double rest_accelerometer_sigma_m_s2 =
      0.5;  ///< With more spread of the accelerometer than this the vehicle is moving.
  static constexpr double zero_velocity_sigma_m_s =
      0.02;  ///< Standard deviation of the zero velocity measured at rest.
  static constexpr double zero_rotation_sigma_rad_s =
      0.01;  ///< Standard deviation of the zero rotation measured at rest.
  static constexpr double gate_sigma =
      4.0;  ///< Measurements farther off than this many standard deviations, for each degree of freedom, are outliers.
  static constexpr double recovery_s =
      0.4;  ///< The gate of heights, or of a camera's poses, that was closed for this long is opened by force.
  static constexpr double pose_recovery_s =
      1.5;  ///< A gate of the laser's relative poses that was closed for this long is opened by force; until then
            ///< inertia is used alone, which a slope ahead does not mislead.
  static constexpr int max_recoveries =
      3;  ///< More forced openings than this within recovery_window_s are a divergence.
  static constexpr double recovery_window_s = 5.0;  ///< Time within which forced openings are counted.
  static constexpr double max_speed_m_s = 8.0;      ///< A faster estimate is a divergence.
  static constexpr double horizontal_timeout_s =
      0.5;  ///< Without a relative pose for this long the horizontal estimate is degraded.
  double vertical_timeout_s =
      6.0;  ///< Without a height for this long the vertical estimate is degraded; over slopes there is none.
  /// A corridor's axis is measured by the airframe's drag alone, which leaves half a metre per second in gusts
  /// (decision 018); with less the vehicle would come down in every corridor without features.
  static constexpr double valid_velocity_sigma_m_s =
      0.7;  ///< Standard deviation up to which the velocity may be used for control.
  static constexpr double valid_height_sigma_m =
      0.25;  ///< Standard deviation up to which the height may be used for control.
  static constexpr double diverged_velocity_sigma_m_s =
      3.0;  ///< Standard deviation of the velocity beyond which the filter has diverged.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
