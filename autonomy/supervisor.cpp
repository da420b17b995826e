#include "autonomy/supervisor.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Severity;
using common::Time;

void SupervisorConfig::describe(common::config::Fields& fields) {
  fields("laser_hold_s", laser_hold_s, {0.05, 10}, "Without a usable scan for this long the vehicle holds.");
  fields("laser_land_s", laser_land_s, {0.1, 10}, "Without a usable scan for this long the vehicle lands.");
  fields("battery_land_share", battery_land_share, {0, 0.9},
         "Remaining charge at which the vehicle lands where it is.");
}

std::vector<std::string> SupervisorConfig::validate() const {
  return common::Validation().atMost("laser_hold_s", laser_hold_s, "laser_land_s", laser_land_s).problems();
}

std::optional<common::CommandResult> Supervisor::take(const common::OperatorCommand& command, Time now) {
  const common::CommandResult accepted{command.id, true, {}};
  if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    operator_holds_ = true;
    goes_home_ = false;
    return accepted;
  }
  if (std::holds_alternative<common::ResumeCommand>(command.kind)) return resume(command.id);
  if (std::holds_alternative<common::LandCommand>(command.kind)) {
    if (!supervision_.land) landed_by_operator_ = true;
    land(now, "the operator asked for it");
    return accepted;
  }
  return std::nullopt;
}

common::CommandResult Supervisor::resume(std::uint64_t id) {
  if (!operator_holds_ && !goes_home_) {
    const std::string reason = holdReason();
    return {id, false, reason.empty() ? "nothing is on hold" : reason + ": that hold ends by itself"};
  }
  operator_holds_ = goes_home_ = false;
  return {id, true, {}};
}

common::CommandResult Supervisor::goHome(const common::OperatorCommand& command) {
  if (flight_ != common::FlightState::kFlying)
    return {command.id, false, fmt::format("the vehicle is not flying: {}", common::toString(flight_))};
  goes_home_ = true;
  operator_holds_ = false;
  ++flights_home_;
  return {command.id, true, "the mission holds meanwhile, and goes on after Resume"};
}

void Supervisor::homeEnded(Time now, bool reached, std::string reason) {
  goes_home_ = false;
  operator_holds_ = true;
  say(now, reached ? Severity::kInfo : Severity::kWarning, reached ? "home reached" : "home not reached",
      reached ? "the vehicle holds until Resume or Land" : std::move(reason));
}

std::string Supervisor::refusal() const {
  if (!control::isAirborne(flight_)) return {};
  if (supervision_.land) return "the vehicle is landing: " + supervision_.land_reason;
  const bool landing = flight_ == common::FlightState::kLanding || flight_ == common::FlightState::kEmergencyLanding;
  return landing ? "the vehicle is landing" : "";
}

void Supervisor::pilotArrived(Time now, bool takes_over) {
  if (takes_over == pilot_flies_) return;
  pilot_flies_ = takes_over;
  say(now, Severity::kWarning, takes_over ? "hold" : "resume",
      takes_over ? "the pilot took over" : "the pilot gave control back");
}

bool Supervisor::batteryArrived(Time now, const common::BatterySample& sample) {
  const bool plausible = std::isfinite(sample.voltage_v) && std::isfinite(sample.remaining);
  if (plausible != battery_plausible_)
    say(now, plausible ? Severity::kInfo : Severity::kWarning,
        plausible ? "the battery is measured again" : "the battery's last good values are kept",
        plausible ? "" : "its voltage or its charge is not a finite number");
  battery_plausible_ = plausible;
  return plausible;
}

const Supervision& Supervisor::tick(Time now, common::FlightState flight, const common::EnergyLayer& energy) {
  flight_ = flight;
  const bool airborne = control::isAirborne(flight);
  const double silent_s = last_scan_ ? (now - *last_scan_).seconds() : 0.0;
  if (airborne && silent_s > config_.laser_land_s) land(now, fmt::format("no scan for {:.1f} s", silent_s));
  const bool laser_holds = airborne && silent_s > config_.laser_hold_s;
  if (laser_holds != laser_holds_)
    say(now, laser_holds ? Severity::kWarning : Severity::kInfo, laser_holds ? "hold" : "scans are back",
        laser_holds ? fmt::format("no scan for {:.2f} s", silent_s) : "");
  laser_holds_ = laser_holds;

  if (airborne && energy.battery_remaining < config_.battery_land_share)
    land(now, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining));

  supervision_.hold_reason = holdReason();
  supervision_.hold = !supervision_.hold_reason.empty();
  supervision_.home = goes_home_ && !laser_holds_ && !pilot_flies_ ? flights_home_ : 0;
  return supervision_;
}

/// Empty if nothing holds the mission.
std::string Supervisor::holdReason() const {
  if (pilot_flies_) return "the pilot flies";
  if (laser_holds_) return "the laser is silent";
  if (goes_home_) return "the operator wants it home";
  return operator_holds_ ? "the operator holds" : "";
}

std::vector<common::Event> Supervisor::takeEvents() { return std::exchange(events_, {}); }

void Supervisor::land(Time now, std::string reason) {
  if (supervision_.land) return;
  supervision_.land = true;
  supervision_.land_reason = reason;
  say(now, Severity::kWarning, "land", std::move(reason));
}

void Supervisor::say(Time now, Severity severity, std::string text, std::string reason) {
  events_.push_back({now, severity, "supervisor", std::move(text), std::move(reason)});
}

}  // namespace swiftlet::autonomy
