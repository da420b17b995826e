// The data sheet of a vehicle and its sensors, known to both the autonomy and the simulator. It is loaded from
// config/vehicles and config/sensors and includes the laser's noise. Properties that the autonomy does not know (drag,
// lag, bias) are in simulation/.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"

namespace swiftlet::common {

struct Pose3;

/// A mount: position in the body frame and roll, pitch, yaw in degrees (YAML), giving T_body_sensor.
struct MountConfig {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;

  void describe(config::Fields& fields);
  Pose3 pose() const;
};

/// A 2D laser and the mirror that deflects some of its beams down.
struct LaserConfig {
  std::string name = "utm_30lx";
  int beams = 1081;
  double field_of_view_deg = 270.0;
  double rate_hz = 40.0;
  double sweep_s = 0.01875;
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  double range_noise_m = 0.01;
  double dropout_rate = 0.002;
  int mirror_first_beam = 0;
  int mirror_beams = 0;
  double mirror_spread_deg = 2.0;
  MountConfig mount;         ///< T_body_laser.
  MountConfig mirror_mount;  ///< T_body_mirror: origin of the deflected beams, which point along its -z, fanned about
                             ///< its x axis.

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;

  double angleMin_rad() const;
  double angleIncrement_rad() const;
  bool isMirrorBeam(int beam) const { return beam >= mirror_first_beam && beam < mirror_first_beam + mirror_beams; }
  /// The unit direction of a beam in the laser frame, or of a deflected one in the mirror frame.
  Eigen::Vector3d direction(int beam) const;
};

/// The airframe as the planner and the controller need it.
struct VehicleConfig {
  std::string name = "cobra";
  double mass_kg = 1.6;
  double arm_m = 0.165;
  double hull_diameter_m = 0.55;
  double hull_height_m = 0.25;
  double max_thrust_n = 28.0;
  double max_tilt_deg = 20.0;
  double battery_full_v = 12.6;
  double battery_empty_v = 10.2;
  double battery_capacity_ah = 5.0;
  double max_height_m = 2.0;

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;

  double hullRadius_m() const { return 0.5 * hull_diameter_m; }
};

}  // namespace swiftlet::common
