#include "perception/fusion/fusion_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

using common::config::kPositive;

namespace {

/// When a measurement is an outlier, and when the estimate may not be used.
void describeValidity(FusionConfig& config, common::config::Fields& fields) {
  fields("gate_sigma", config.gate_sigma, {1, 100},
         "Measurements farther off than this many standard deviations, for each degree of freedom, are outliers.");
  fields("recovery_s", config.recovery_s, {0.05, 10},
         "The gate of heights, or of a camera's poses, that was closed for this long is opened by force.");
  fields("pose_recovery_s", config.pose_recovery_s, {0.05, 10},
         "A gate of the laser's relative poses that was closed for this long is opened by force; until then inertia is "
         "believed, which a slope ahead does not mislead.");
  fields("max_recoveries", config.max_recoveries, {0, 1000},
         "More forced openings than this within recovery_window_s are a divergence.");
  fields("recovery_window_s", config.recovery_window_s, kPositive, "Time within which forced openings are counted.");
  fields("max_speed_m_s", config.max_speed_m_s, kPositive, "A faster estimate is a divergence.");
  fields("horizontal_timeout_s", config.horizontal_timeout_s, kPositive,
         "Without a relative pose for this long the horizontal estimate is degraded.");
  fields("vertical_timeout_s", config.vertical_timeout_s, kPositive,
         "Without a height for this long the vertical estimate is degraded; over slopes there is none.");
  fields("valid_velocity_sigma_m_s", config.valid_velocity_sigma_m_s, kPositive,
         "Standard deviation up to which the velocity may be used for control.");
  fields("valid_height_sigma_m", config.valid_height_sigma_m, kPositive,
         "Standard deviation up to which the height may be used for control.");
  fields("diverged_velocity_sigma_m_s", config.diverged_velocity_sigma_m_s, kPositive,
         "Standard deviation of the velocity beyond which the filter has diverged.");
}

}  // namespace

void FusionConfig::describe(common::config::Fields& fields) {
  fields("history_s", history_s, {0.1, 10}, "Greatest delay with which a measurement may come.");
  fields("gravity_m_s2", gravity_m_s2, {9.7, 9.9}, "Magnitude of gravity.");
  fields("accelerometer_noise_m_s2_rthz", accelerometer_noise_m_s2_rthz, kPositive,
         "Least noise density of the accelerometer; what the samples show counts where it is more.");
  fields("gyroscope_noise_rad_s_rthz", gyroscope_noise_rad_s_rthz, kPositive, "Noise density of the gyroscope.");
  fields("predicted_force_noise_m_s2_rthz", predicted_force_noise_m_s2_rthz, kPositive,
         "Noise density of a specific force that the thrust predicts: 5 % of gravity for a second.");
  fields("predicted_rate_noise_rad_s_rthz", predicted_rate_noise_rad_s_rthz, kPositive,
         "Noise density of a rate of rotation that the setpoints predict: 2 deg after a tenth of a second.");
  fields("predicted_tilt_sigma_deg", predicted_tilt_sigma_deg, {0.01, 30},
         "Standard deviation of a roll or pitch that the setpoints predict, each time that attitudes are used.");
  fields("accelerometer_bias_walk_m_s3_rthz", accelerometer_bias_walk_m_s3_rthz, kPositive,
         "Random walk of the accelerometer's bias.");
  fields("gyroscope_bias_walk_rad_s2_rthz", gyroscope_bias_walk_rad_s2_rthz, kPositive,
         "Random walk of the gyroscope's bias.");
  fields("accelerometer_bias_sigma_m_s2", accelerometer_bias_sigma_m_s2, kPositive,
         "Standard deviation of the accelerometer's bias at the start.");
  fields("use_ahrs", use_ahrs,
         "Whether roll and pitch of the vehicle's own AHRS are measurements. With false it may be missing: the filter "
         "starts by gravity.");
  fields("ahrs_sigma_deg", ahrs_sigma_deg, {0.01, 30}, "Standard deviation of the AHRS's roll and pitch.");
  fields("ahrs_correlation_s", ahrs_correlation_s, {0, 600},
         "Correlation time of the AHRS's error; the noise is widened to match.");
  fields(
      "use_gravity", use_gravity,
      "Whether the specific force is taken for gravity, for vehicles without an AHRS; then it is not taken for drag.");
  fields("gravity_sigma_m_s2", gravity_sigma_m_s2, {0.01, 20},
         "Standard deviation of the specific force from gravity, by the vehicle's own acceleration.");
  fields("gravity_gate_m_s2", gravity_gate_m_s2, kPositive,
         "A specific force whose size differs from gravity by more is not taken for it.");
  fields("attitude_rate_hz", attitude_rate_hz, {0.1, 200},
         "Rate at which AHRS, gravity, drag and what is known at rest are used.");
  fields("use_drag", use_drag,
         "Whether the specific force along the body's x and y is taken for drag, which measures the velocity through "
         "the air where the laser does not.");
  fields("drag_1_s", drag_1_s, {0.0, 10},
         "Deceleration per speed through the air at the start, 0.1 to 0.5 for small quadrotors; learned in flight.");
  fields("drag_sigma_1_s", drag_sigma_1_s, {0.0, 10}, "Standard deviation of drag_1_s at the start.");
  fields("drag_walk_1_s_rts", drag_walk_1_s_rts, {0.0, 10},
         "Random walk of the drag, which changes with speed, battery and height.");
  fields("drag_noise_m_s2_rthz", drag_noise_m_s2_rthz, kPositive, "Noise density of the force that is taken for drag.");
  fields("wind_sigma_m_s", wind_sigma_m_s, {0.0, 20}, "Standard deviation of each component of the wind at the start.");
  fields("wind_walk_m_s_rts", wind_walk_m_s_rts, {0.0, 20}, "Random walk of each component of the wind.");
  fields("laser_yaw_sigma_deg", laser_yaw_sigma_deg, {0.0, 10},
         "Standard deviation of the yaw by which the laser is mounted otherwise than its data sheet says.");
  fields("laser_position_sigma_m", laser_position_sigma_m, {0.0, 0.1},
         "Standard deviation of the x and y by which the laser is mounted otherwise than its data sheet says.");
  fields("laser_clock_sigma_s", laser_clock_sigma_s, {0.0, 0.1},
         "Standard deviation of the time by which the laser's stamps are off.");
  fields("rest_s", rest_s, {0.1, 10}, "Duration of the samples at rest that the start averages.");
  fields("rest_gyroscope_sigma_rad_s", rest_gyroscope_sigma_rad_s, kPositive,
         "With more spread of the gyroscope than this the vehicle is moving.");
  fields("rest_accelerometer_sigma_m_s2", rest_accelerometer_sigma_m_s2, kPositive,
         "With more spread of the accelerometer than this the vehicle is moving.");
  fields("zero_velocity_sigma_m_s", zero_velocity_sigma_m_s, kPositive,
         "Standard deviation of the zero velocity measured at rest.");
  fields("zero_rotation_sigma_rad_s", zero_rotation_sigma_rad_s, kPositive,
         "Standard deviation of the zero rotation measured at rest.");
  describeValidity(*this, fields);
}

}  // namespace swiftlet::perception
