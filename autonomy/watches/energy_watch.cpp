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
  if (!control::isAirborne(condition.flight)) {
    charge_said_ = 1.0;
    return request;
  }
  tellGauge(now, condition.charge_counted_on, request);
  tellCharge(now, condition.energy, request);
  if (condition.flight == FlightState::kFlying && !condition.lands) watchHome(now, condition.energy, request);
  watchThrust(now, condition, request);
  if (condition.energy.battery_remaining < config_.battery_land_share)
    request.land = fmt::format("{:.0f} % of the battery left", 100.0 * condition.energy.battery_remaining);
  return request;
}

std::string EnergyWatch::takeOffRefusal(const common::EnergyLayer& energy) const {
  if (!(energy.battery_voltage_v > 0.0)) return "the battery has not been measured";
  if (energy.thrust_margin > 0.0 && energy.thrust_margin < config_.least_thrust_margin)
    return fmt::format("the thrust is at most {:.2f} times the weight; {:.2f} is needed", energy.thrust_margin,
                       config_.least_thrust_margin);
  const double least = config_.battery_land_share + config_.home_reserve_share;
  if (energy.battery_remaining < least)
    return fmt::format("{:.0f} % of the battery are left; {:.0f} % are needed, and it lands at {:.0f} %",
                       100.0 * energy.battery_remaining, 100.0 * least, 100.0 * config_.battery_land_share);
  return {};
}

void EnergyWatch::tellGauge(Time now, const std::string& counted_on, WatchRequest& request) {
  if (counted_on.empty() != counted_on_said_) return;
  counted_on_said_ = !counted_on.empty();
  if (counted_on_said_)
    request.say(now, Severity::kWarning, "the charge is counted on by the current", counted_on);
  else
    request.say(now, Severity::kInfo, "the battery's gauge is believed again");
}

void EnergyWatch::tellCharge(Time now, const common::EnergyLayer& energy, WatchRequest& request) {
  for (const double share : {0.3, 0.2}) {
    if (charge_said_ <= share || energy.battery_remaining > share) continue;
    charge_said_ = share;
    const std::string left =
        energy.seconds_left ? fmt::format("{:.1f} min until it lands", *energy.seconds_left / 60.0) : "";
    request.say(now, Severity::kWarning, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining),
                left, common::Concern::kLowBattery);
  }
}

void EnergyWatch::watchHome(Time now, const common::EnergyLayer& energy, WatchRequest& request) {
  if (!energy.home_share) return;
  if (turned_back_) return watchReach(now, energy, request);
  const double needed = config_.home_need_factor * *energy.home_share;
  const double land_share = std::max(config_.battery_land_share, energy.land_share);
  if (energy.battery_remaining - land_share - config_.home_reserve_share > needed) return;
  turned_back_ = true;
  request.home = fmt::format(
      "turned back with {:.0f} % of the battery left, {:.0f} % to fly {:.1f} m home{}, and {:.0f} % at which {}",
      100.0 * energy.battery_remaining, 100.0 * *energy.home_share, energy.home_m.value_or(0.0),
      energy.home_planned ? "" : " along its trail, as no path is known", 100.0 * land_share,
      land_share > config_.battery_land_share ? "the thrust carries the weight no longer" : "it lands");
  request.say(now, Severity::kWarning, "turn back", request.home, common::Concern::kTurnBack);
}

/// During the flight home: the vehicle flies as far as the charge goes, and lands there.
void EnergyWatch::watchReach(Time now, const common::EnergyLayer& energy, WatchRequest& request) {
  // Predictions differ from the truth, and from each other, by some percent.
  constexpr double kClearly = 0.8;
  const double left = energy.battery_remaining - std::max(config_.battery_land_share, energy.land_share);
  if (out_of_reach_said_ || !energy.home_planned || left > kClearly * *energy.home_share) return;
  out_of_reach_said_ = true;
  request.say(now, Severity::kWarning, "home is out of reach",
              fmt::format("{:.0f} % to fly {:.1f} m home, {:.0f} % left to fly with: it lands on the way",
                          100.0 * *energy.home_share, energy.home_m.value_or(0.0), 100.0 * std::max(0.0, left)),
              common::Concern::kHome);
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
