#include "simulation/sensors/sensor_config.hpp"

#include <cmath>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/validation.hpp"

namespace swiftlet::simulation {

using common::config::kPositive;

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
    case Sensor::kRgbd:
      return "rgbd";
    case Sensor::kVerticalLaser:
      return "vertical_laser";
  }
  return "?";
}

void LinkConfig::describe(common::config::Fields& fields) {
  fields("latency_s", latency_s, {0, 10}, "Time from the end of the measurement to its arrival.");
  fields("jitter_s", jitter_s, {0, 10}, "Greatest further delay, uniform from 0.");
  fields("loss_rate", loss_rate, {0, 1}, "Share of measurements that never arrive.");
  fields("in_order", in_order, "Whether measurements never overtake each other on the link.");
  fields("outage_every_s", outage_every_s, {0, 1e6},
         "Mean time between outages in which every measurement is lost; 0 without outages.");
  fields("outage_s", outage_s, {0, 60}, "Length of an outage.");
}

void ImuConfig::describe(common::config::Fields& fields) {
  fields("rate_hz", rate_hz, {1, 1000}, "Samples a second; a divisor of 1000.");
  fields("gyro_noise_rad_s", gyro_noise_rad_s, {0, 1}, "Standard deviation of a gyroscope sample.");
  fields("gyro_bias_rad_s", gyro_bias_rad_s, {0, 1}, "Standard deviation of the gyroscope's bias at the start.");
  fields("gyro_bias_walk_rad_s", gyro_bias_walk_rad_s, {0, 1},
         "Growth of the gyroscope's bias, as a standard deviation, in one second.");
  fields("accel_noise_m_s2", accel_noise_m_s2, {0, 10}, "Standard deviation of an accelerometer sample.");
  fields("accel_bias_m_s2", accel_bias_m_s2, {0, 10}, "Standard deviation of the accelerometer's bias at the start.");
  fields("accel_bias_walk_m_s2", accel_bias_walk_m_s2, {0, 10},
         "Growth of the accelerometer's bias, as a standard deviation, in one second.");
  fields("tilt_error_deg", tilt_error_deg, {0, 20}, "Standard deviation of the slow error of roll and of pitch.");
  fields("tilt_error_time_s", tilt_error_time_s, kPositive, "Correlation time of the slow error of roll and pitch.");
  fields("tilt_noise_deg", tilt_noise_deg, {0, 20}, "Standard deviation of the fast error of roll and of pitch.");
  fields("tilt_per_accel_deg", tilt_per_accel_deg, {0, 10},
         "Lean of roll and pitch under a lasting acceleration of 1 m/s^2.");
  fields("tilt_accel_time_s", tilt_accel_time_s, kPositive,
         "Time constant of the lean of roll and pitch under a lasting acceleration.");
  fields("yaw_drift_deg_s", yaw_drift_deg_s, {0, 20}, "Standard deviation of the constant drift of yaw.");
  fields("yaw_walk_deg", yaw_walk_deg, {0, 20}, "Growth of yaw's standard deviation in one second.");
  fields("vibration_m_s2", vibration_m_s2, {0, 50},
         "Further standard deviation of an accelerometer sample at full thrust; it goes with the thrust.");
  fields(
      "rectification_m_s2", rectification_m_s2, {0, 5},
      "Mean shift of the vertical accelerometer at the thrust that carries the data sheet's mass, up or down by seed; "
      "it goes with the squared thrust. The other two axes have up to half of it.");
}

std::vector<common::Problem> ImuConfig::validate() const {
  return common::Validation()
      .require(std::fmod(1000.0, rate_hz) == 0.0, "rate_hz",
               common::Message("imu.rate", "1000 is not a multiple of it"))
      .problems();
}

void CameraConfig::describe(common::config::Fields& fields) {
  fields("width_px", width_px, {16, 4096}, "Columns of a frame.");
  fields("height_px", height_px, {16, 4096}, "Rows of a frame.");
  fields("rate_hz", rate_hz, {0.1, 100}, "Frames a second.");
  fields("field_of_view_deg", field_of_view_deg, {10, 150}, "Horizontal angle of view.");
  fields("pixel_noise", pixel_noise, {0, 100}, "Standard deviation of a pixel, in grey levels of 255.");
  fields.section("mount", mount, "Camera in the body frame; it looks along its +x.");
}

void LaserErrorsConfig::describe(common::config::Fields& fields) {
  fields.section(
      "mount_error", mount_error,
      "Motion about the body's origin from the mounts of laser and mirror on the data sheet to the true ones.");
  fields("incidence_bias_m", incidence_bias_m, {0, 0.5},
         "Range that a beam at 60 deg to the surface's normal reads too much; the bias goes with 1 / cos - 1.");
  fields("mixed_pixel_rate", mixed_pixel_rate, {0, 1},
         "Share of beams at an edge that read a range between the two surfaces.");
  fields("dark_range_m", dark_range_m, {0, 100},
         "Range beyond which a black surface returns nothing; a white one is seen at any range. 0: all are seen.");
  fields("daylight_range_share", daylight_range_share, {0, 1},
         "What is left of the range at which a surface is seen where daylight falls on it; it needs a dark_range_m.");
  fields("sun_dropout_rate", sun_dropout_rate, {0, 1}, "Share of beams towards the sun that return nothing.");
  fields("sun_direction_deg", sun_direction_deg, {-360, 360}, "Heading of the sun in the world's frame.");
  fields("sun_width_deg", sun_width_deg, {0, 180}, "Angle to each side of the sun within which beams drop out.");
  fields(
      "glass_angle_deg", glass_angle_deg, {0, 90},
      "Angle to its normal up to which glass returns a beam; at greater ones the beam goes through to what is behind. "
      "0: glass is seen as a wall is.");
  fields("clock_offset_s", clock_offset_s, {-0.1, 0.1}, "What the laser's clock is ahead of the computer's at first.");
  fields("clock_drift_ppm", clock_drift_ppm, {-1000, 1000}, "What the laser's clock gains, in parts per million.");
}

void RgbdErrorsConfig::describe(common::config::Fields& fields) {
  fields.section("mount_error", mount_error,
                 "Motion about the body's origin from the camera's mount on the data sheet to the true one.");
  fields("focal_share", focal_share, {0.5, 2}, "True focal length over that of the data sheet.");
  fields("inverse_depth_bias_1_m", inverse_depth_bias_1_m, {-0.1, 0.1},
         "What every inverse depth reads too much. The error of a depth is this times the depth squared.");
  fields(
      "dark_range_m", dark_range_m, {0, 100},
      "Distance beyond which a black surface across the view has no depth; others are seen from farther, by the root "
      "of their reflectance and of the cosine of the incidence. 0: all have depth.");
  fields("glancing_deg", glancing_deg, {0, 90}, "Incidence, from the normal, beyond which a surface has no depth.");
  fields("edge_hole_rate", edge_hole_rate, {0, 1}, "Share of pixels at the far side of an edge that have no depth.");
  fields("pixel_noise", pixel_noise, {0, 100},
         "Standard deviation of a pixel, in grey levels of 255; it grows with the exposure's gain.");
  fields("exposure_s", exposure_s, {0, 0.1}, "How long the shutter is open, which blurs what moves.");
  fields("longest_exposure_s", longest_exposure_s, {0, 0.1},
         "How long the shutter is open at most in the dark, before the picture is amplified; in brighter light it is "
         "open for less than exposure_s. Not above exposure_s: it is always open for that.");
  fields("exposure_lag_s", exposure_lag_s, {0, 60},
         "Time constant in which the exposure follows the brightness of the view; 0: the exposure is fixed.");
  fields("clock_offset_s", clock_offset_s, {-0.1, 0.1}, "What the camera's clock is ahead of the computer's at first.");
  fields("clock_drift_ppm", clock_drift_ppm, {-1000, 1000}, "What the camera's clock gains, in parts per million.");
}

common::Pose3 RgbdErrorsConfig::T_body_camera(const common::MountConfig& sheet) const {
  return mount_error.pose() * sheet.pose();
}

void FuelGaugeConfig::describe(common::config::Fields& fields) {
  fields("initial_error", initial_error, {-0.5, 0.5},
         "Error of the charge that the gauge reads from the open-circuit voltage at the start, as a share of the full "
         "one.");
  fields("gain_error", gain_error, {-0.5, 0.5}, "Relative error of the current that the gauge measures and counts.");
}

void SensorsConfig::describe(common::config::Fields& fields) {
  fields.section("imu", imu, "Inertial sensors and attitude.");
  fields.section("laser_errors", laser_errors, "Errors of the laser beyond its data sheet.");
  fields.section("camera", camera, "The camera of the operator's stream.");
  fields.section("rgbd_errors", rgbd_errors, "Errors of the RGB-D camera beyond its data sheet.");
  fields.section("vertical_laser_errors", vertical_laser_errors, "Errors of the upright laser beyond its data sheet.");
  fields("battery_rate_hz", battery_rate_hz, {0.1, 100}, "Battery samples a second.");
  fields("battery_noise_v", battery_noise_v, {0, 5}, "Standard deviation of the battery's voltage.");
  fields.section("fuel_gauge", fuel_gauge, "Errors of the estimated charge.");
  fields("pilot_rate_hz", pilot_rate_hz, {1, 200}, "Samples of the pilot's sticks a second.");
  fields.section("imu_link", imu_link, "Link of inertial samples to the computer.");
  fields.section("laser_link", laser_link, "Link of scans to the computer.");
  fields.section("battery_link", battery_link, "Link of battery samples to the computer.");
  fields.section("pilot_link", pilot_link, "Link of the sticks to the computer.");
  fields.section("camera_link", camera_link, "Link of camera frames to the computer.");
  fields.section("rgbd_link", rgbd_link, "Link of RGB-D frames to the computer.");
  fields.section("vertical_laser_link", vertical_laser_link, "Link of scans of the upright laser to the computer.");
  fields.section("command_link", command_link, "Link of setpoints to the autopilot.");
}

}  // namespace swiftlet::simulation
