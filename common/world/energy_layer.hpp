// The World's layer of energy: the battery.
#pragma once

namespace swiftlet::common {

struct EnergyLayer {
  double battery_voltage_v = 0.0;  ///< The last measurement; 0 before the first one.
  double battery_remaining = 1.0;  ///< In [0, 1].

  bool operator==(const EnergyLayer&) const = default;
};

}  // namespace swiftlet::common
