#include "simulation/sensors/fuel_gauge.hpp"

#include <algorithm>

namespace swiftlet::simulation {

// start + initial_error - (1 + gain_error) * drawn, written so that both errors are added to the true charge.
double gaugedCharge(const FuelGaugeConfig& gauge, double charge_at_start, const Battery& battery) {
  const double drawn = charge_at_start - battery.remaining();
  return std::clamp(battery.remaining() + gauge.initial_error - gauge.gain_error * drawn, 0.0, 1.0);
}

double gaugedCurrent_a(const FuelGaugeConfig& gauge, const Battery& battery) {
  return (1.0 + gauge.gain_error) * battery.current_a();
}

}  // namespace swiftlet::simulation
