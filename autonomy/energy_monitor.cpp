#include "autonomy/energy_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::config::kPositive;
namespace {

/// From this drop of the gauge on, it tells more about the capacity than the data sheet.
constexpr double kTellingDrop = 0.05;

double smoothed(double value, double next, double dt_s, double filter_s) {
  return value + std::min(1.0, dt_s / filter_s) * (next - value);
}

}  // namespace

void EnergyConfig::describe(common::config::Fields& fields) {
  fields("power_filter_s", power_filter_s, kPositive, "Time constant that smooths current and power.");
  fields("home_speed_m_s", home_speed_m_s, {0.05, 10}, "Speed along paths before one has been flown.");
  fields("home_speed_filter_s", home_speed_filter_s, kPositive, "Time constant of the speed along paths.");
  fields("home_stops_s", home_stops_s, {0, 120},
         "Time for the turn before the flight home and for the landing after it.");
}

EnergyMonitor::EnergyMonitor(const EnergyConfig& config, const common::VehicleConfig& vehicle, double voltage_exponent)
    : config_(config),
      capacity_as_(3600.0 * vehicle.battery_capacity_ah),
      home_speed_m_s_(config.home_speed_m_s),
      curve_(vehicle),
      voltage_exponent_(voltage_exponent) {}

void EnergyMonitor::add(const common::BatterySample& sample, bool airborne, double thrust_margin) {
  thrust_margin_ = thrust_margin;
  const double dt_s = last_ ? std::max(0.0, (sample.stamps.measured - last_->stamps.measured).seconds()) : 0.0;
  const double power_w = sample.voltage_v * sample.current_a;
  if (airborne && !flown_) {
    flown_ = true;
    current_a_ = sample.current_a;
    power_w_ = power_w;
    voltage_v_ = sample.voltage_v;
    margin_ = thrust_margin;
    remaining_at_take_off_ = sample.remaining;
    drawn_as_ = 0.0;
  } else if (airborne) {
    current_a_ = smoothed(current_a_, sample.current_a, dt_s, config_.power_filter_s);
    power_w_ = smoothed(power_w_, power_w, dt_s, config_.power_filter_s);
    margin_ = smoothed(margin_, thrust_margin, dt_s, config_.power_filter_s);
    voltage_v_ = smoothed(voltage_v_, sample.voltage_v, dt_s, config_.power_filter_s);
    drawn_as_ += sample.current_a * dt_s;
  }
  last_ = sample;
}

void EnergyMonitor::followed(double speed_m_s, double dt_s) {
  if (std::isfinite(speed_m_s))
    home_speed_m_s_ = smoothed(home_speed_m_s_, speed_m_s, dt_s, config_.home_speed_filter_s);
}

/// Share of the full battery a second.
double EnergyMonitor::consumption_1_s() const {
  const double drop = last_ ? remaining_at_take_off_ - last_->remaining : 0.0;
  const double capacity_as = drop > kTellingDrop && drawn_as_ > 0.0 ? drawn_as_ / drop : capacity_as_;
  return current_a_ / capacity_as;
}

common::EnergyLayer EnergyMonitor::layer(const std::optional<double>& home_m, double land_share,
                                         double least_margin) const {
  common::EnergyLayer layer;
  if (!last_) return layer;
  layer.battery_voltage_v = last_->voltage_v;
  layer.battery_remaining = last_->remaining;
  layer.power_w = power_w_;
  layer.thrust_margin = thrust_margin_;
  layer.land_share = land_share;
  if (flown_)
    layer.land_share = std::max(
        land_share, curve_.chargeAtMargin({last_->remaining, voltage_v_, margin_}, least_margin, voltage_exponent_));
  layer.home_m = home_m;
  const double consumption = consumption_1_s();
  if (!flown_ || !(consumption > 0.0)) return layer;
  layer.seconds_left = std::max(0.0, last_->remaining - layer.land_share) / consumption;
  constexpr double kLeast_m_s = 0.1;
  if (home_m) layer.home_share = consumption * (*home_m / std::max(kLeast_m_s, home_speed_m_s_) + config_.home_stops_s);
  return layer;
}

}  // namespace swiftlet::autonomy
