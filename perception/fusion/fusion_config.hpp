// The configuration of the fusion filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/gravity.hpp"
#include "perception/fusion/odometry_choice.hpp"

namespace swiftlet::perception {

struct FusionConfig {
  OdometryRule odometry_choice = OdometryRule::kAll;
  double gravity_m_s2 = common::kGravity_m_s2;  ///< Magnitude of gravity.
  double accelerometer_noise_m_s2_rthz = 0.02;
  double gyroscope_noise_rad_s_rthz = 0.002;
  double accelerometer_bias_walk_m_s3_rthz = 0.003;
  double gyroscope_bias_walk_rad_s2_rthz = 0.0005;
  double accelerometer_bias_sigma_m_s2 = 0.2;  ///< Standard deviation of the accelerometer's bias at the start.
  bool use_ahrs = true;
  double ahrs_sigma_deg = 1.0;
  static constexpr double ahrs_correlation_s =
      10.0;  ///< Correlation time of the AHRS's error; the noise is widened to match.
  bool use_gravity = false;
  static constexpr double attitude_rate_hz =
      10.0;              ///< Rate at which AHRS, gravity, drag and what is known at rest are used.
  bool use_drag = true;  ///< Whether the specific force along the body's x and y is taken for drag, which measures the
                         ///< velocity through the air where the laser does not.
  double drag_1_s = 0.3;
  /// Noise of the drag by draughts of 0.3 m/s that last for 2 s (Gauss-Markov), as they act on slower motion: drag *
  /// sigma * sqrt(2 tau). With that of the accelerometer alone, flights hit walls (docs/decisions/fusion.md#018).
  double drag_noise_m_s2_rthz = 0.1;
  // What errors of the laser's mount and clock do to the estimate (docs/decisions/fusion.md#083).
  double laser_yaw_sigma_deg =
      0.6;  ///< Standard deviation of the yaw by which the laser is mounted otherwise than its data sheet says.
  double laser_position_sigma_m =
      0.006;  ///< Standard deviation of the x and y by which the laser is mounted otherwise than its data sheet says.
  double laser_clock_sigma_s = 0.003;  ///< Standard deviation of the time by which the laser's stamps are off.
  static constexpr double zero_velocity_sigma_m_s =
      0.02;                                         ///< Standard deviation of the zero velocity measured at rest.
  static constexpr double recovery_window_s = 5.0;  ///< Time within which forced openings are counted.
  static constexpr double horizontal_timeout_s =
      0.5;  ///< Without a relative pose for this long the horizontal estimate is degraded; a camera's delay is added.
  double vertical_timeout_s =
      6.0;  ///< Without a height for this long the vertical estimate is degraded; over slopes there is none.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
