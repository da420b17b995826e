// The World's layer of energy: the battery, and what is left to fly with.
#pragma once

#include <optional>

namespace swiftlet::common {

struct EnergyLayer {
  double battery_voltage_v = 0.0;  ///< The last measurement; 0 before the first one.
  double battery_remaining = 1.0;  ///< In [0, 1].
  double power_w = 0.0;            ///< Drawn from the battery, smoothed.
  /// Greatest thrust over the weight at the present voltage, as learned in flight: at 1 the vehicle can only just
  /// hover.
  double thrust_margin = 0.0;
  /// Charge at which the vehicle will have to land, because it is too low or can no longer carry the weight.
  double land_share = 0.0;
  /// Time until that charge, at the present consumption; nullopt before the consumption of the flight is
  /// known, some seconds after the take-off.
  std::optional<double> seconds_left;
  std::optional<double> home_m;  ///< Length of the path home; nullopt before it is known or assumed.
  bool home_planned = false;     ///< The length home is that of a path; else a conservative one, as no path is known.
  std::optional<double> home_share;  ///< Charge, as a share of the full battery, that it takes to fly home and land.

  bool operator==(const EnergyLayer&) const = default;
};

}  // namespace swiftlet::common
