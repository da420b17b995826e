// What was identified of one vehicle from its flights (`swiftlet identify`), as a file that a profile names.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/vehicle_config.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::control {

/// One degree of freedom: acceleration = gain * u + damping * velocity + offset, where u is the command behind a lag of
/// first order (Bachrach 2009, equations 1 and 2; the lag is ours). For the yaw, the rate takes the place of the
/// acceleration. Each value has half of the width of its 95 % interval beside it.
struct AxisModel {
  double gain = 0.0;  ///< k, or k1: acceleration per command.
  double gain_interval = 0.0;
  double offset = 0.0;  ///< b.
  double offset_interval = 0.0;
  double damping_1_s = 0.0;  ///< k2; 0 where the model of equation 1 is used.
  double damping_interval_1_s = 0.0;
  double lag_s = 0.0;
  double residual = 0.0;  ///< Standard deviation of what the model does not explain.

  void describe(common::config::Fields& fields);
};

/// One row of the mapping from a command to the angle that the vehicle takes (Grzonka 2012, Fig. 4).
struct CommandAngle {
  double command_deg = 0.0;
  double angle_deg = 0.0;

  void describe(common::config::Fields& fields);
};

struct VehicleModel {
  static constexpr int kVersion = 1;

  int version = 0;
  std::string vehicle;  ///< Name on the data sheet of the vehicle it is of.
  // The battery that the table of thrust was learned with.
  double battery_full_v = 0.0;
  double battery_empty_v = 0.0;
  double battery_capacity_ah = 0.0;
  AxisModel forward;    ///< Acceleration along x of the level body frame per pitch command (m/s^2 per rad).
  AxisModel left;       ///< Acceleration along y of the level body frame per roll command (m/s^2 per rad); k < 0.
  AxisModel up;         ///< Vertical acceleration per command over C(U), the one that carries the weight (m/s^2).
  AxisModel yaw;        ///< Yaw rate per commanded rate.
  ThrustPoints thrust;  ///< C(U) by rising voltage.
  std::vector<CommandAngle> bench_pitch;
  std::vector<CommandAngle> bench_roll;

  void describe(common::config::Fields& fields);
  /// An axis that was identified must be one that a multirotor can have, see problemsOfAxis.
  std::vector<common::Problem> validate() const;

  /// Why the model cannot be used for this vehicle, with its own keys and without places; empty if it fits.
  std::vector<common::Problem> problemsFor(const common::VehicleConfig& vehicle) const;
  /// Whether every degree of freedom was identified, as an LQR needs it.
  bool hasAxes() const;
};

/// Why no multirotor can have such an identified axis, "forward.gain: the reason"; empty for one that has not been
/// identified. `axis` is the key of the axis in VehicleModel. The bounds are wide: an LQR divides by the gain, so that
/// a wrong sign or size would fly the vehicle into a wall.
std::vector<common::Problem> problemsOfAxis(const std::string& axis, const AxisModel& model);

/// The command for which the vehicle takes that angle, by a bench's rows of rising commands and angles; the angle
/// itself without rows. Beyond the rows the mapping continues with a slope of 1.
double commandFor(double angle_rad, const std::vector<CommandAngle>& rows);

}  // namespace swiftlet::control
