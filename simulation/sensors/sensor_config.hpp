// What only nature knows of the sensors: errors, rates, latency and loss on the way to the computer.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::simulation {

/// The order in which measurements that arrive at the same instant are delivered.
enum class Sensor { kImu, kLaser, kBattery, kPilot, kCamera };
inline constexpr int kSensorCount = 5;
const char* toString(Sensor sensor);

/// The way from a sensor to the computer. Measurements of one sensor never overtake each other.
struct LinkConfig {
  double latency_s = 0.001;
  double jitter_s = 0.0;  ///< Uniform in [0, jitter], added.
  double loss_rate = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// Inertial sensors and the attitude the autopilot makes of them.
struct ImuConfig {
  double rate_hz = 200.0;
  double gyro_noise_rad_s = 0.005;       ///< Standard deviation of a sample.
  double gyro_bias_rad_s = 0.004;        ///< Standard deviation of the bias at the start.
  double gyro_bias_walk_rad_s = 0.0005;  ///< Growth of its standard deviation in one second.
  double accel_noise_m_s2 = 0.08;
  double accel_bias_m_s2 = 0.05;
  double accel_bias_walk_m_s2 = 0.002;
  double tilt_error_deg = 0.7;       ///< Standard deviation of the slow error of roll and of pitch.
  double tilt_error_time_s = 15.0;   ///< Its correlation time.
  double tilt_noise_deg = 0.08;      ///< Standard deviation of the fast error.
  double tilt_per_accel_deg = 0.25;  ///< Leaning into a lasting horizontal acceleration, per m/s^2.
  double tilt_accel_time_s = 1.5;    ///< How slowly it leans.
  double yaw_drift_deg_s = 0.05;     ///< Standard deviation of the constant drift.
  double yaw_walk_deg = 0.05;        ///< Growth of the standard deviation in one second.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct CameraConfig {
  int width_px = 320;
  int height_px = 240;
  double rate_hz = 10.0;
  double field_of_view_deg = 70.0;                     ///< Horizontal.
  double pixel_noise = 2.0;                            ///< Standard deviation in grey levels of 255.
  common::MountConfig mount{.x_m = 0.1, .z_m = 0.05};  ///< Looks along its +x.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct SensorsConfig {
  ImuConfig imu;
  CameraConfig camera;
  double battery_rate_hz = 5.0;
  double battery_noise_v = 0.02;
  double pilot_rate_hz = 20.0;
  LinkConfig imu_link{.latency_s = 0.001};
  LinkConfig laser_link{.latency_s = 0.004, .jitter_s = 0.002, .loss_rate = 0.0};
  LinkConfig battery_link{.latency_s = 0.010};
  LinkConfig pilot_link{.latency_s = 0.020};
  LinkConfig camera_link{.latency_s = 0.030};
  LinkConfig command_link{.latency_s = 0.004};  ///< Setpoints, to the autopilot.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::simulation
