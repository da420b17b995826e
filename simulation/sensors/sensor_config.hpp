// Properties of the sensors that only the simulator knows: errors, rates, and the latency and loss of their links.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::simulation {

/// The order in which measurements that arrive at the same instant are delivered.
enum class Sensor { kImu, kLaser, kBattery, kPilot, kCamera, kRgbd, kVerticalLaser };
inline constexpr int kSensorCount = 7;
const char* toString(Sensor sensor);

/// The link from a sensor to the computer.
struct LinkConfig {
  double latency_s = 0.001;
  double jitter_s = 0.0;
  double loss_rate = 0.0;
  bool in_order = true;
  double outage_every_s = 0.0;
  double outage_s = 0.1;

  void describe(common::config::Fields& fields);
};

/// Inertial sensors and the attitude that the autopilot computes from them.
struct ImuConfig {
  double rate_hz = 200.0;
  double gyro_noise_rad_s = 0.005;
  double gyro_bias_rad_s = 0.004;
  double gyro_bias_walk_rad_s = 0.0005;
  double accel_noise_m_s2 = 0.08;
  double accel_bias_m_s2 = 0.05;
  double accel_bias_walk_m_s2 = 0.002;
  double tilt_error_deg = 0.7;
  double tilt_error_time_s = 15.0;
  double tilt_noise_deg = 0.08;
  double tilt_per_accel_deg = 0.25;
  double tilt_accel_time_s = 1.5;
  double yaw_drift_deg_s = 0.05;
  double yaw_walk_deg = 0.05;
  double vibration_m_s2 = 0.0;
  double rectification_m_s2 = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct CameraConfig {
  int width_px = 320;
  int height_px = 240;
  double rate_hz = 10.0;
  double field_of_view_deg = 70.0;
  double pixel_noise = 2.0;
  common::MountConfig mount{.x_m = 0.1, .z_m = 0.05};

  void describe(common::config::Fields& fields);
};

/// How a laser's ranges differ from the distance to the nearest surface, beyond the noise on its data sheet.
struct LaserErrorsConfig {
  common::MountConfig mount_error;
  double incidence_bias_m = 0.0;
  double mixed_pixel_rate = 0.0;
  double dark_range_m = 0.0;
  double daylight_range_share = 1.0;
  double sun_dropout_rate = 0.0;
  double sun_direction_deg = 0.0;
  double sun_width_deg = 30.0;
  double glass_angle_deg = 0.0;
  double clock_offset_s = 0.0;
  double clock_drift_ppm = 0.0;

  void describe(common::config::Fields& fields);
  /// Whether ranges depend on which surface was hit and at what angle.
  bool needsSurfaces() const { return incidence_bias_m > 0.0 || dark_range_m > 0.0 || glass_angle_deg > 0.0; }
};

/// How an RGB-D camera differs from its data sheet, and how it sees colours.
struct RgbdErrorsConfig {
  common::MountConfig mount_error;
  double focal_share = 1.0;
  double inverse_depth_bias_1_m = 0.0;
  double dark_range_m = 0.0;
  double glancing_deg = 90.0;
  double edge_hole_rate = 0.0;
  double pixel_noise = 2.0;
  double exposure_s = 0.0;
  double longest_exposure_s = 0.0;
  double exposure_lag_s = 0.0;
  double clock_offset_s = 0.0;
  double clock_drift_ppm = 0.0;

  void describe(common::config::Fields& fields);
  double longestExposure_s() const { return std::max(exposure_s, longest_exposure_s); }
  /// The true pose of a camera that its data sheet mounts so.
  common::Pose3 T_body_camera(const common::MountConfig& sheet) const;
};

/// Errors of the fuel gauge, which counts the current from a charge that it guesses at the start.
struct FuelGaugeConfig {
  double initial_error = 0.0;
  double gain_error = 0.0;

  void describe(common::config::Fields& fields);
};

struct SensorsConfig {
  ImuConfig imu;
  LaserErrorsConfig laser_errors;
  CameraConfig camera;
  RgbdErrorsConfig rgbd_errors;
  LaserErrorsConfig vertical_laser_errors;
  double battery_rate_hz = 5.0;
  double battery_noise_v = 0.02;
  FuelGaugeConfig fuel_gauge;
  double pilot_rate_hz = 20.0;
  LinkConfig imu_link{.latency_s = 0.001};
  LinkConfig laser_link{.latency_s = 0.004, .jitter_s = 0.002, .loss_rate = 0.0};
  LinkConfig battery_link{.latency_s = 0.010};
  LinkConfig pilot_link{.latency_s = 0.020};
  LinkConfig camera_link{.latency_s = 0.030};
  LinkConfig rgbd_link{.latency_s = 0.030};
  LinkConfig vertical_laser_link{.latency_s = 0.004, .jitter_s = 0.002, .loss_rate = 0.0};
  LinkConfig command_link{.latency_s = 0.004};

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::simulation
