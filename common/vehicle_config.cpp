#include "common/vehicle_config.hpp"

#include <cmath>

#include "common/validation.hpp"

namespace swiftlet::common {

void MountConfig::describe(config::Fields& fields) {
  fields("x_m", x_m, "Forward of the body origin.");
  fields("y_m", y_m, "Left of it.");
  fields("z_m", z_m, "Above it.");
  fields("roll_deg", roll_deg, "Rotation about x.");
  fields("pitch_deg", pitch_deg, "Rotation about y.");
  fields("yaw_deg", yaw_deg, "Rotation about z.");
}

std::vector<std::string> MountConfig::validate() const {
  return Validation()
      .within("x_m", x_m, -2, 2)
      .within("y_m", y_m, -2, 2)
      .within("z_m", z_m, -2, 2)
      .within("roll_deg", roll_deg, -360, 360)
      .within("pitch_deg", pitch_deg, -360, 360)
      .within("yaw_deg", yaw_deg, -360, 360)
      .problems();
}

Pose3 MountConfig::pose() const {
  return {quaternionFrom({roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg}), {x_m, y_m, z_m}};
}

void LaserConfig::describe(config::Fields& fields) {
  fields("name", name, "For messages.");
  fields("beams", beams, "Beams of one sweep, those on the mirror included.");
  fields("field_of_view_deg", field_of_view_deg, "From the first to the last beam.");
  fields("rate_hz", rate_hz, "Sweeps a second.");
  fields("sweep_s", sweep_s, "From the first to the last beam of a sweep.");
  fields("range_min_m", range_min_m, "Shortest valid range.");
  fields("range_max_m", range_max_m, "Longest valid range.");
  fields("range_noise_m", range_noise_m, "Standard deviation of a range.");
  fields("dropout_rate", dropout_rate, "Share of beams without a return.");
  fields("mirror_first_beam", mirror_first_beam, "First beam on the mirror.");
  fields("mirror_beams", mirror_beams, "Beams on the mirror, 0 for none.");
  fields("mirror_spread_deg", mirror_spread_deg, "Angle between the first and the last beam on the mirror.");
  fields.section("mount", mount, "Laser in the body frame.");
  fields.section("mirror_mount", mirror_mount,
                 "Origin of the deflected beams in the body frame; they point along its -z.");
}

std::vector<std::string> LaserConfig::validate() const {
  return Validation()
      .within("beams", beams, 2, 100'000)
      .within("field_of_view_deg", field_of_view_deg, 1, 360)
      .within("rate_hz", rate_hz, 0.1, 1000)
      .within("sweep_s", sweep_s, 0, 1.0 / rate_hz)
      .within("range_min_m", range_min_m, 0, range_max_m)
      .within("range_max_m", range_max_m, 0.1, 1000)
      .within("range_noise_m", range_noise_m, 0, 1)
      .within("dropout_rate", dropout_rate, 0, 1)
      .within("mirror_first_beam", mirror_first_beam, 0, beams)
      .within("mirror_beams", mirror_beams, 0, static_cast<double>(beams) - mirror_first_beam)
      .within("mirror_spread_deg", mirror_spread_deg, 0, 90)
      .problems();
}

double LaserConfig::angleMin_rad() const { return -0.5 * field_of_view_deg * kRadPerDeg; }
double LaserConfig::angleIncrement_rad() const { return field_of_view_deg * kRadPerDeg / (beams - 1); }

Eigen::Vector3d LaserConfig::direction(int beam) const {
  if (isMirrorBeam(beam)) {
    const double share =
        mirror_beams > 1 ? static_cast<double>(beam - mirror_first_beam) / (mirror_beams - 1) - 0.5 : 0.0;
    const double fan_rad = share * mirror_spread_deg * kRadPerDeg;
    return {0.0, std::sin(fan_rad), -std::cos(fan_rad)};
  }
  const double angle_rad = angleMin_rad() + beam * angleIncrement_rad();
  return {std::cos(angle_rad), std::sin(angle_rad), 0.0};
}

void VehicleConfig::describe(config::Fields& fields) {
  fields("name", name, "For messages.");
  fields("mass_kg", mass_kg, "Take-off mass.");
  fields("hull_diameter_m", hull_diameter_m, "Tip to tip, rotors included.");
  fields("hull_height_m", hull_height_m, "Height of the hull about the body origin.");
  fields("max_thrust_n", max_thrust_n, "Greatest collective thrust at full battery.");
  fields("max_tilt_deg", max_tilt_deg, "Greatest commanded roll or pitch.");
  fields("battery_full_v", battery_full_v, "Voltage of the full battery at rest.");
  fields("battery_empty_v", battery_empty_v, "Voltage at which it must be on the ground.");
}

std::vector<std::string> VehicleConfig::validate() const {
  return Validation()
      .within("mass_kg", mass_kg, 0.05, 100)
      .within("hull_diameter_m", hull_diameter_m, 0.05, 5)
      .within("hull_height_m", hull_height_m, 0.02, 2)
      .within("max_thrust_n", max_thrust_n, mass_kg * 9.81 * 1.1, 10'000)
      .within("max_tilt_deg", max_tilt_deg, 1, 60)
      .within("battery_full_v", battery_full_v, battery_empty_v, 100)
      .within("battery_empty_v", battery_empty_v, 1, 100)
      .problems();
}

}  // namespace swiftlet::common
