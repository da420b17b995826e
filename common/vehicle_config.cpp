#include "common/vehicle_config.hpp"

#include <cmath>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "common/validation.hpp"

namespace swiftlet::common {

void MountConfig::describe(config::Fields& fields) {
  fields("x_m", x_m, {-2, 2}, "Position forward of the body's origin.");
  fields("y_m", y_m, {-2, 2}, "Position left of the body's origin.");
  fields("z_m", z_m, {-2, 2}, "Position above the body's origin.");
  fields("roll_deg", roll_deg, {-360, 360}, "Rotation about the body's x axis, applied first.");
  fields("pitch_deg", pitch_deg, {-360, 360}, "Rotation about the body's y axis, applied second.");
  fields("yaw_deg", yaw_deg, {-360, 360}, "Rotation about the body's z axis, applied last.");
}

Pose3 MountConfig::pose() const {
  return {quaternionFrom({roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg}), {x_m, y_m, z_m}};
}

void LaserConfig::describe(config::Fields& fields) {
  fields("name", name, "Name of the laser, for messages.");
  fields("beams", beams, {2, 100'000}, "Beams of one sweep, those on the mirror included.");
  fields("field_of_view_deg", field_of_view_deg, {1, 360}, "Angle from the first to the last beam.");
  fields("rate_hz", rate_hz, {0.1, 1000}, "Sweeps a second.");
  fields("sweep_s", sweep_s, {0, 10}, "Time from the first to the last beam of a sweep, at most one period.");
  fields("range_min_m", range_min_m, {0, 1000}, "Shortest valid range.");
  fields("range_max_m", range_max_m, {0.1, 1000}, "Longest valid range.");
  fields("range_noise_m", range_noise_m, {0, 1}, "Standard deviation of a range up to 10 m.");
  fields("dropout_rate", dropout_rate, {0, 1}, "Share of beams without a return.");
  fields("mirror_first_beam", mirror_first_beam, {0, 100'000}, "First beam that the mirror deflects.");
  fields("mirror_beams", mirror_beams, {0, 100'000},
         "Beams that the mirror deflects straight down, 0 without a mirror.");
  fields("mirror_spread_deg", mirror_spread_deg, {0, 90}, "Angle between the first and the last deflected beam.");
  fields.section("mount", mount, "Pose of the laser in the body frame.");
  fields.section("mirror_mount", mirror_mount,
                 "Origin of the deflected beams in the body frame; they point along its -z, fanned about its x axis.");
}

std::vector<Problem> LaserConfig::validate() const {
  return Validation()
      .require(sweep_s <= 1.0 / rate_hz, "sweep_s",
               Message("laser.sweep-too-long", "{} is more than one period of rate_hz", sweep_s))
      .atMost("range_min_m", range_min_m, "range_max_m", range_max_m)
      .atMost("mirror_first_beam", mirror_first_beam, "beams", beams)
      .require(mirror_beams <= static_cast<double>(beams) - mirror_first_beam, "mirror_beams",
               Message("laser.too-many-mirror-beams", "{} are more than follow on mirror_first_beam", mirror_beams))
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
  fields("name", name, "Name of the vehicle, for messages.");
  fields("mass_kg", mass_kg, {0.05, 100}, "Take-off mass.");
  fields("arm_m", arm_m, {0.02, 2}, "Distance from the centre to a rotor's axis.");
  fields("hull_diameter_m", hull_diameter_m, {0.05, 5},
         "Diameter from rotor tip to rotor tip; the hull is an upright cylinder about the body's origin.");
  fields("hull_height_m", hull_height_m, {0.02, 2}, "Height of the hull, half of it above the body's origin.");
  fields("max_thrust_n", max_thrust_n, {0.1, 10'000},
         "Greatest collective thrust at full battery, at least 1.1 times the weight.");
  fields("max_tilt_deg", max_tilt_deg, {1, 60}, "Greatest commanded roll or pitch.");
  fields("battery_full_v", battery_full_v, {1, 100}, "Voltage of the full battery at rest.");
  fields("battery_empty_v", battery_empty_v, {1, 100}, "Voltage at which the vehicle must be on the ground.");
  fields("battery_capacity_ah", battery_capacity_ah, {0.05, 1000}, "Charge of the full battery.");
  fields("max_height_m", max_height_m, {0.3, 100},
         "Greatest height over the take-off floor, as no sensor looks up; a mission's TakeOff may name another.");
}

std::vector<Problem> VehicleConfig::validate() const {
  return Validation()
      .require(max_thrust_n >= 1.1 * kGravity_m_s2 * mass_kg, "max_thrust_n",
               Message("vehicle.too-heavy", "{} is less than 1.1 times the weight of {} kg", max_thrust_n, mass_kg))
      .require(2.0 * arm_m < hull_diameter_m, "arm_m",
               Message("vehicle.arm-too-long", "{} does not fit into a hull of {} m", arm_m, hull_diameter_m))
      .atMost("battery_empty_v", battery_empty_v, "battery_full_v", battery_full_v)
      .problems();
}

}  // namespace swiftlet::common
