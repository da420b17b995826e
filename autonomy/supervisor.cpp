#include "autonomy/supervisor.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

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
    if (!operator_holds_) say(now, Severity::kInfo, "hold", "the operator asked for it");
    operator_holds_ = true;
    return accepted;
  }
  if (std::holds_alternative<common::ResumeCommand>(command.kind)) {
    if (operator_holds_) say(now, Severity::kInfo, "resume", "the operator asked for it");
    operator_holds_ = false;
    return accepted;
  }
  if (std::holds_alternative<common::LandCommand>(command.kind)) {
    if (!supervision_.land) landed_by_operator_ = true;
    land(now, "the operator asked for it");
    return accepted;
  }
  return std::nullopt;
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

const Supervision& Supervisor::tick(Time now, bool airborne, const common::EnergyLayer& energy) {
  const double silent_s = last_scan_ ? (now - *last_scan_).seconds() : 0.0;
  if (airborne && silent_s > config_.laser_land_s) land(now, fmt::format("no scan for {:.1f} s", silent_s));
  const bool laser_holds = airborne && silent_s > config_.laser_hold_s;
  if (laser_holds != laser_holds_)
    say(now, laser_holds ? Severity::kWarning : Severity::kInfo, laser_holds ? "hold" : "scans are back",
        laser_holds ? fmt::format("no scan for {:.2f} s", silent_s) : "");
  laser_holds_ = laser_holds;

  if (airborne && energy.battery_remaining < config_.battery_land_share)
    land(now, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining));

  supervision_.hold = operator_holds_ || laser_holds_ || pilot_flies_;
  supervision_.hold_reason = pilot_flies_      ? "the pilot flies"
                             : laser_holds_    ? "the laser is silent"
                             : operator_holds_ ? "the operator holds"
                                               : "";
  return supervision_;
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
