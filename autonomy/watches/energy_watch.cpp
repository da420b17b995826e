#include "autonomy/watches/energy_watch.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::Severity;
using common::Time;

WatchRequest EnergyWatch::watch(Time now, const VehicleCondition& condition) {
  WatchRequest request;
  if (!control::isAirborne(condition.flight)) return request;
  tellCharge(now, condition.energy, request);
  if (condition.flight == FlightState::kFlying) watchHome(now, condition.energy, request);
  watchThrust(now, condition, request);
  if (condition.energy.battery_remaining < config_.battery_land_share)
    request.land = fmt::format("{:.0f} % of the battery left", 100.0 * condition.energy.battery_remaining);
  return request;
}

void EnergyWatch::tellCharge(Time now, const common::EnergyLayer& energy, WatchRequest& request) {
  for (const double share : {0.3, 0.2}) {
    if (charge_said_ <= share || energy.battery_remaining > share) continue;
    charge_said_ = share;
    const std::string left =
        energy.seconds_left ? fmt::format("{:.1f} min until it lands", *energy.seconds_left / 60.0) : "";
    request.say(now, Severity::kWarning, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining),
                left);
  }
}

void EnergyWatch::watchHome(Time now, const common::EnergyLayer& energy, WatchRequest& request) {
  if (turned_back_ || !energy.home_share) return;
  const double needed = config_.home_need_factor * *energy.home_share;
  const double land_share = std::max(config_.battery_land_share, energy.land_share);
  if (energy.battery_remaining - land_share - config_.home_reserve_share > needed) return;
  turned_back_ = true;
  request.home = fmt::format(
      "turned back with {:.0f} % of the battery left, {:.0f} % to fly {:.1f} m home, and {:.0f} % at which {}",
      100.0 * energy.battery_remaining, 100.0 * *energy.home_share, energy.home_m.value_or(0.0), 100.0 * land_share,
      land_share > config_.battery_land_share ? "the thrust carries the weight no longer" : "it lands");
  request.say(now, Severity::kWarning, "turn back", request.home);
}

/// A gust may take the margin for a moment.
void EnergyWatch::watchThrust(Time now, const VehicleCondition& condition, WatchRequest& request) {
  const double margin = condition.energy.thrust_margin;
  const bool weak = condition.flight == FlightState::kFlying && margin > 0.0 && margin < config_.least_thrust_margin;
  if (!weak) weak_since_.reset();
  if (weak && !weak_since_) weak_since_ = now;
  if (weak && (now - *weak_since_).seconds() >= config_.thrust_margin_s)
    request.land = fmt::format("the thrust is at most {:.2f} times the weight", margin);
}

}  // namespace swiftlet::autonomy
