// The World's layer of energy: what is left to fly with.
#pragma once

namespace swiftlet::common {

struct EnergyLayer {
  double battery_voltage_v = 0.0;  ///< As measured last; 0 before the first measurement.
  double battery_remaining = 1.0;  ///< In [0, 1].

  bool operator==(const EnergyLayer&) const = default;
};

}  // namespace swiftlet::common
