#include "simulation/sensors/fuel_gauge.hpp"

#include <algorithm>

namespace swiftlet::simulation {

FuelGauge::FuelGauge(const FuelGaugeConfig& config, double remaining_at_start)
    : config_(config), remaining_at_start_(remaining_at_start) {}

// start + initial_error - (1 + gain_error) * drawn, written so that both errors are added to the true charge.
double FuelGauge::remaining(const Battery& battery) const {
  const double drawn = remaining_at_start_ - battery.remaining();
  return std::clamp(battery.remaining() + config_.initial_error - config_.gain_error * drawn, 0.0, 1.0);
}

double FuelGauge::current_a(const Battery& battery) const { return (1.0 + config_.gain_error) * battery.current_a(); }

}  // namespace swiftlet::simulation
