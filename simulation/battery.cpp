#include "simulation/battery.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::simulation {

void Battery::Config::describe(common::config::Fields& fields) {
  fields("capacity_ah", capacity_ah, {0, 100}, "Charge of the full battery; 0: that of the data sheet.");
  fields("resistance_ohm", resistance_ohm, {0, 1}, "Inner resistance, which makes the voltage sag under load.");
  fields("electronics_w", electronics_w, {0, 1000}, "Power of computer and sensors.");
  fields("power_w_per_n15", power_w_per_n15, {0, 100},
         "Electrical power of one motor per thrust to the power of 1.5 (momentum theory of a hovering rotor).");
  fields("voltage_exponent", voltage_exponent, {0, 4},
         "The thrust of a throttle goes with (voltage / full voltage) to this power.");
}

Battery::Battery(const common::VehicleConfig& vehicle, const Config& config, double remaining)
    : config_(config),
      full_v_(vehicle.battery_full_v),
      empty_v_(vehicle.battery_empty_v),
      remaining_(std::clamp(remaining, 0.0, 1.0)) {
  voltage_v_ = openCircuit_v();  // Here all members have their values.
  if (config_.capacity_ah <= 0.0) config_.capacity_ah = vehicle.battery_capacity_ah;
}

// The curve of a lithium-polymer cell: steep at both ends, flat between them. The empty voltage is that of charge 0.
double Battery::openCircuit_v() const {
  const double s = remaining_;
  const double shape = 0.62 * s + 0.18 * (1.0 - std::exp(-20.0 * s)) + 0.20 * std::exp(-8.0 * (1.0 - s));
  return sound_share_ * (empty_v_ + (full_v_ - empty_v_) * std::min(1.0, shape));
}

void Battery::loseCells(int count) {
  constexpr double kFullCell_v = 4.2;
  const double cells = std::max(1.0, std::round(full_v_ / kFullCell_v));
  sound_share_ = std::max(0.0, cells - count) / cells;
}

void Battery::draw(double power_w, double step_s) {
  // P = U I and U = U0 - R I. The root with the smaller current is stable; beyond the greatest power U drops to U0 / 2.
  const double open_v = openCircuit_v(), r = sound_share_ * config_.resistance_ohm;
  if (open_v <= 0.0) {
    voltage_v_ = current_a_ = 0.0;
    return;
  }
  const double discriminant = std::max(0.0, open_v * open_v - 4.0 * r * (power_w + config_.electronics_w));
  voltage_v_ = 0.5 * (open_v + std::sqrt(discriminant));
  current_a_ = r > 0.0 ? (open_v - voltage_v_) / r : (power_w + config_.electronics_w) / open_v;
  remaining_ = std::max(0.0, remaining_ - current_a_ * step_s / (3600.0 * config_.capacity_ah));
}

double Battery::thrustShare() const {
  const double ratio = voltage_v_ / full_v_;
  return config_.voltage_exponent == 2.0 ? ratio * ratio : std::pow(ratio, config_.voltage_exponent);
}

}  // namespace swiftlet::simulation
