#include "autonomy/energy/energy_monitor.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {
namespace {

/// Slow links send the battery once a second (docs/decisions/fail_safes.md#079).
constexpr double kUnheard_s = 2.5;
/// Time constant that smooths current and power.
constexpr double kPowerFilter_s = 20.0;
/// Time constant of the speed along paths.
constexpr double kHomeSpeedFilter_s = 30.0;
/// Time that the flight home takes beyond its path and its landing: turning, slowing down, stopping.
constexpr double kHomeStops_s = 2.0;
/// The mean current is that of the flight, and not of motors that spool up, after this time and once the present
/// current differs from it by no more than this share. Smoothed from the first sample on, it made a vehicle land at
/// 396 s, far from home (docs/decisions/fail_safes.md).
constexpr double kSettled_s = 6.0, kSettledWithin = 0.25;

bool hasCurrent(const common::BatterySample& sample) {
  return std::isfinite(sample.current_a) && sample.current_a > 0.0;
}

double smoothed(double value, double next, double dt_s, double filter_s) {
  return filter_s > 0.0 ? value + std::min(1.0, dt_s / filter_s) * (next - value) : next;
}

}  // namespace

void EnergyConfig::describe(common::config::Fields& fields) {
  fields("home_speed_m_s", home_speed_m_s, {0.05, 10}, "Speed along paths before one has been flown.");
}

EnergyMonitor::EnergyMonitor(const EnergyConfig& config, const common::VehicleConfig& vehicle, double voltage_exponent)
    : charge_(3600.0 * vehicle.battery_capacity_ah),
      home_speed_m_s_(config.home_speed_m_s),
      curve_(vehicle),
      voltage_exponent_(voltage_exponent) {}

void EnergyMonitor::add(const common::BatterySample& sample, bool airborne, double thrust_margin, double speed_m_s) {
  const double dt_s = last_ ? std::max(0.0, (sample.stamps.measured - last_->stamps.measured).seconds()) : 0.0;
  const double current_a = currentOf_a(sample);
  charge_.read(sample.remaining);
  const bool takes_off = airborne && !airborne_;
  airborne_ = airborne;
  if (takes_off) {
    flown_ = true;
    taken_off_ = sample.stamps.measured;
    current_a_ = current_a;
    power_w_ = sample.voltage_v * current_a;
    voltage_v_ = sample.voltage_v;
    margin_ = thrust_margin;
    charge_.takeOff(sample.remaining);
    settled_ = false;
  } else if (airborne) {
    // A plain mean at first: the motors draw little in the samples before the vehicle has lifted.
    const double filter_s = std::min(kPowerFilter_s, (sample.stamps.measured - taken_off_).seconds());
    current_a_ = smoothed(current_a_, current_a, dt_s, filter_s);
    power_w_ = smoothed(power_w_, sample.voltage_v * current_a, dt_s, filter_s);
    margin_ = smoothed(margin_, thrust_margin, dt_s, filter_s);
    voltage_v_ = smoothed(voltage_v_, sample.voltage_v, dt_s, filter_s);
    charge_.draw(current_a, dt_s, hasCurrent(sample));
    settled_ = settled_ || ((sample.stamps.measured - taken_off_).seconds() >= kSettled_s &&
                            std::abs(current_a - current_a_) <= kSettledWithin * current_a_);
  }
  if (airborne) current_model_.add(current_a, speed_m_s, dt_s);
  last_ = sample;
}

/// Without a measured current: the mean current by which the gauge has fallen, or the last one while the drop is small.
double EnergyMonitor::currentOf_a(const common::BatterySample& sample) const {
  if (hasCurrent(sample)) return sample.current_a;
  if (!flown_) return current_a_;
  return charge_.meanCurrent_a(sample.remaining, (sample.stamps.measured - taken_off_).seconds()).value_or(current_a_);
}

void EnergyMonitor::followed(double speed_m_s, double dt_s) {
  if (!std::isfinite(speed_m_s)) return;
  // Exploring stops and turns at every viewpoint, a path home does not: a mean would be too slow. This follows the
  // quantile: it rests where the speed is exceeded in a share of 1 - kCruise of the time.
  constexpr double kCruise = 0.7, kRange_m_s = 0.5;
  const double step_m_s = kRange_m_s * std::min(1.0, dt_s / kHomeSpeedFilter_s);
  home_speed_m_s_ += speed_m_s > home_speed_m_s_ ? kCruise * step_m_s : (kCruise - 1.0) * step_m_s;
}

double EnergyMonitor::unheard_s(common::Time now) const {
  const double age_s = last_ && flown_ ? (now - last_->stamps.arrived).seconds() : 0.0;
  return age_s > kUnheard_s ? age_s : 0.0;
}

std::string EnergyMonitor::gaugeFault(common::Time now) const {
  if (unheard_s(now) > 0.0) return fmt::format("no battery sample for {:.1f} s", kUnheard_s);
  if (charge_.standsStill())
    return fmt::format("the gauge has not moved while {:.0f} % of the capacity were drawn",
                       100.0 * ChargeCounter::kUnmoved);
  return {};
}

double EnergyMonitor::remaining(common::Time now) const {
  if (gaugeFault(now).empty()) return last_->remaining;
  return charge_.counted(unheard_s(now) * current_a_);
}

common::EnergyLayer EnergyMonitor::layer(common::Time now, const FlightHome& home, double thrust_margin,
                                         double land_share, double least_margin) const {
  common::EnergyLayer layer;
  if (!last_) return layer;
  layer.battery_voltage_v = last_->voltage_v;
  layer.battery_remaining = remaining(now);
  layer.power_w = power_w_;
  layer.thrust_margin = thrust_margin;
  layer.land_share = land_share;
  if (flown_)
    layer.land_share = std::max(
        land_share, curve_.chargeAtMargin({last_->remaining, voltage_v_, margin_}, least_margin, voltage_exponent_));
  if (!flown_ || !(current_a_ > 0.0)) return layer;
  if (settled_)
    layer.seconds_left = std::max(0.0, layer.battery_remaining - layer.land_share) * charge_.capacity_as() / current_a_;
  tellHome(home, layer);
  return layer;
}

/// Without a path the vehicle would fly along its trail.
void EnergyMonitor::tellHome(const FlightHome& home, common::EnergyLayer& layer) const {
  // The learned speed falls to zero while the vehicle hovers, which is not the speed of a flight home.
  constexpr double kLeast_m_s = 0.1;
  layer.home_planned = home.planned_m.has_value();
  layer.home_m = home.planned_m.value_or(home.trail_m);
  const double fly_s = *layer.home_m / std::max(kLeast_m_s, home_speed_m_s_);
  const double drawn_as =
      current_model_.drawn_as(fly_s, *layer.home_m) + current_model_.drawn_as(kHomeStops_s + home.landing_s, 0.0);
  layer.home_share = drawn_as / charge_.capacity_as();
}

}  // namespace swiftlet::autonomy
