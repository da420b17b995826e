// The fuel gauge: the charge as a power module estimates it. It reads a first charge from the voltage at rest and from
// then on counts the current that it measures (coulomb counting), so that both errors stay to the end of the flight.
#pragma once

#include "simulation/battery.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

class FuelGauge {
 public:
  /// `remaining_at_start` is the true charge, as a share of the full one.
  FuelGauge(const FuelGaugeConfig& config, double remaining_at_start);

  /// Estimate in [0, 1]; without errors exactly the true charge.
  double remaining(const Battery& battery) const;
  double current_a(const Battery& battery) const;

 private:
  FuelGaugeConfig config_;
  double remaining_at_start_;
};

}  // namespace swiftlet::simulation
