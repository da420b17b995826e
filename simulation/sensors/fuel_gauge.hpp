// The fuel gauge: the charge as a power module estimates it. It reads a first charge from the voltage at rest and from
// then on counts the current that it measures (coulomb counting), so that both errors stay to the end of the flight.
#pragma once

#include "simulation/battery.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

/// Estimate in [0, 1]; without errors exactly the true charge. `charge_at_start` is the true one.
double gaugedCharge(const FuelGaugeConfig& gauge, double charge_at_start, const Battery& battery);
double gaugedCurrent_a(const FuelGaugeConfig& gauge, const Battery& battery);

}  // namespace swiftlet::simulation
