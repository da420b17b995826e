#include "simulation/sensors/sensor_config.hpp"

#include <cmath>

#include "common/validation.hpp"

namespace swiftlet::simulation {

const char* toString(Sensor sensor) {
  switch (sensor) {
    case Sensor::kImu:
      return "imu";
    case Sensor::kLaser:
      return "laser";
    case Sensor::kBattery:
      return "battery";
    case Sensor::kPilot:
      return "pilot";
    case Sensor::kCamera:
      return "camera";
  }
  return "?";
}

void LinkConfig::describe(common::config::Fields& fields) {
  fields("latency_s", latency_s, "From the end of the measurement to its arrival.");
  fields("jitter_s", jitter_s, "Added, uniform from 0.");
  fields("loss_rate", loss_rate, "Share of measurements that never arrive.");
}

std::vector<std::string> LinkConfig::validate() const {
  return common::Validation()
      .within("latency_s", latency_s, 0, 10)
      .within("jitter_s", jitter_s, 0, 10)
      .within("loss_rate", loss_rate, 0, 1)
      .problems();
}

void ImuConfig::describe(common::config::Fields& fields) {
  fields("rate_hz", rate_hz, "Samples a second; a divisor of 1000.");
  fields("gyro_noise_rad_s", gyro_noise_rad_s, "Standard deviation of a sample.");
  fields("gyro_bias_rad_s", gyro_bias_rad_s, "Standard deviation of the bias at the start.");
  fields("gyro_bias_walk_rad_s", gyro_bias_walk_rad_s, "Growth of the bias's standard deviation in one second.");
  fields("accel_noise_m_s2", accel_noise_m_s2, "Standard deviation of a sample.");
  fields("accel_bias_m_s2", accel_bias_m_s2, "Standard deviation of the bias at the start.");
  fields("accel_bias_walk_m_s2", accel_bias_walk_m_s2, "Growth of the bias's standard deviation in one second.");
  fields("tilt_error_deg", tilt_error_deg, "Standard deviation of the slow error of roll and of pitch.");
  fields("tilt_error_time_s", tilt_error_time_s, "Correlation time of the slow error.");
  fields("tilt_noise_deg", tilt_noise_deg, "Standard deviation of the fast error.");
  fields("tilt_per_accel_deg", tilt_per_accel_deg, "Lean under a lasting acceleration of 1 m/s^2.");
  fields("tilt_accel_time_s", tilt_accel_time_s, "Time constant of that lean.");
  fields("yaw_drift_deg_s", yaw_drift_deg_s, "Standard deviation of the constant drift of yaw.");
  fields("yaw_walk_deg", yaw_walk_deg, "Growth of yaw's standard deviation in one second.");
}

std::vector<std::string> ImuConfig::validate() const {
  return common::Validation()
      .within("rate_hz", rate_hz, 1, 1000)
      .require(rate_hz > 0 && std::fmod(1000.0, rate_hz) == 0.0, "rate_hz", "1000 is not a multiple of it")
      .within("gyro_noise_rad_s", gyro_noise_rad_s, 0, 1)
      .within("gyro_bias_rad_s", gyro_bias_rad_s, 0, 1)
      .within("gyro_bias_walk_rad_s", gyro_bias_walk_rad_s, 0, 1)
      .within("accel_noise_m_s2", accel_noise_m_s2, 0, 10)
      .within("accel_bias_m_s2", accel_bias_m_s2, 0, 10)
      .within("accel_bias_walk_m_s2", accel_bias_walk_m_s2, 0, 10)
      .within("tilt_error_deg", tilt_error_deg, 0, 20)
      .positive("tilt_error_time_s", tilt_error_time_s)
      .within("tilt_noise_deg", tilt_noise_deg, 0, 20)
      .within("tilt_per_accel_deg", tilt_per_accel_deg, 0, 10)
      .positive("tilt_accel_time_s", tilt_accel_time_s)
      .within("yaw_drift_deg_s", yaw_drift_deg_s, 0, 20)
      .within("yaw_walk_deg", yaw_walk_deg, 0, 20)
      .problems();
}

void CameraConfig::describe(common::config::Fields& fields) {
  fields("width_px", width_px, "Columns.");
  fields("height_px", height_px, "Rows.");
  fields("rate_hz", rate_hz, "Frames a second.");
  fields("field_of_view_deg", field_of_view_deg, "Horizontal angle of view.");
  fields("pixel_noise", pixel_noise, "Standard deviation in grey levels of 255.");
  fields.section("mount", mount, "Camera in the body frame; it looks along its +x.");
}

std::vector<std::string> CameraConfig::validate() const {
  return common::Validation()
      .within("width_px", width_px, 16, 4096)
      .within("height_px", height_px, 16, 4096)
      .within("rate_hz", rate_hz, 0.1, 100)
      .within("field_of_view_deg", field_of_view_deg, 10, 150)
      .within("pixel_noise", pixel_noise, 0, 100)
      .problems();
}

void SensorsConfig::describe(common::config::Fields& fields) {
  fields.section("imu", imu, "Inertial sensors and attitude.");
  fields.section("camera", camera, "Camera.");
  fields("battery_rate_hz", battery_rate_hz, "Battery samples a second.");
  fields("battery_noise_v", battery_noise_v, "Standard deviation of the voltage.");
  fields("pilot_rate_hz", pilot_rate_hz, "Samples of the pilot's sticks a second.");
  fields.section("imu_link", imu_link, "The way of inertial samples to the computer.");
  fields.section("laser_link", laser_link, "The way of scans.");
  fields.section("battery_link", battery_link, "The way of battery samples.");
  fields.section("pilot_link", pilot_link, "The way of the sticks.");
  fields.section("camera_link", camera_link, "The way of camera frames.");
  fields.section("command_link", command_link, "The way of setpoints to the autopilot.");
}

std::vector<std::string> SensorsConfig::validate() const {
  return common::Validation()
      .within("battery_rate_hz", battery_rate_hz, 0.1, 100)
      .within("battery_noise_v", battery_noise_v, 0, 5)
      .within("pilot_rate_hz", pilot_rate_hz, 1, 200)
      .problems();
}

}  // namespace swiftlet::simulation
