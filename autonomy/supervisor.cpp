#include "autonomy/supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Severity;
using common::Time;
namespace {

/// The height counts as known for this long after a measurement.
constexpr double kSeen_s = 0.15;
/// The position counts as known well up to this share of the drift at which the vehicle flies back.
constexpr double kKnownShare = 0.1;

}  // namespace
using common::config::kPositive;

void SupervisorConfig::describe(common::config::Fields& fields) {
  fields("unseen_hold_s", unseen_hold_s, {0.05, 10},
         "When no sensor has seen the surroundings for this long the vehicle holds.");
  fields("unseen_land_s", unseen_land_s, {0.1, 10},
         "When no sensor has seen the surroundings for this long the vehicle lands.");
  fields("battery_land_share", battery_land_share, {0, 0.9},
         "Remaining charge at which the vehicle lands where it is.");
  fields("home_reserve_share", home_reserve_share, {0, 0.9},
         "Charge that is left at home, over that of the landing, when the vehicle turns back in time.");
  fields("home_need_factor", home_need_factor, {1, 3}, "Safety factor of the charge that the flight home takes.");
  fields("least_thrust_margin", least_thrust_margin, {1, 3},
         "Greatest thrust over the weight below which the vehicle lands, while it can still climb.");
  fields("thrust_margin_s", thrust_margin_s, {0, 60}, "The thrust margin must have been too small for this long.");
  fields("height_back_s", height_back_s, kPositive,
         "When the surface below has not been measured for this long the vehicle flies back along its trail.");
  fields("drift_back_m", drift_back_m, kPositive,
         "Standard deviation of the position, grown since the laser last fixed it, at which the vehicle flies back.");
  fields("drift_land_m", drift_land_m, kPositive, "The same, at which it lands.");
  fields("back_known_s", back_known_s, {0, 60},
         "Flying back ends when height and position have been known again for this long.");
}

std::vector<std::string> SupervisorConfig::validate() const {
  return common::Validation()
      .atMost("unseen_hold_s", unseen_hold_s, "unseen_land_s", unseen_land_s)
      .atMost("drift_back_m", drift_back_m, "drift_land_m", drift_land_m)
      .problems();
}

std::optional<common::CommandResult> Supervisor::take(const common::OperatorCommand& command, Time now) {
  const common::CommandResult accepted{command.id, true, {}};
  if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    operator_holds_ = true;
    goes_home_ = goes_home_ && !home_reason_.empty();
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
  if (goes_home_ && !home_reason_.empty()) return {id, false, "it flies home: " + home_reason_};
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
  if (!home_reason_.empty())
    return land(now, reached ? "home again, " + home_reason_ : home_reason_ + "; home not reached: " + reason);
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

void Supervisor::backEnded(Time now) {
  flies_back_ = false;
  if (!unknown_.empty()) land(now, unknown_ + ", also after flying back");
}

const Supervision& Supervisor::tick(Time now, const VehicleCondition& condition) {
  flight_ = condition.flight;
  watchSight(now);
  watchEnergy(now, condition.energy);
  watchPosition(now, condition);

  supervision_.hold_reason = holdReason();
  supervision_.hold = !supervision_.hold_reason.empty();
  const bool may_fly = !blind_holds_ && !pilot_flies_;
  supervision_.back = flies_back_ && may_fly && !operator_holds_ ? flights_back_ : 0;
  supervision_.home = goes_home_ && may_fly && !flies_back_ ? flights_home_ : 0;
  return supervision_;
}

void Supervisor::watchSight(Time now) {
  const bool airborne = control::isAirborne(flight_);
  const double unseen_s = last_sight_ ? (now - *last_sight_).seconds() : 0.0;
  if (airborne && unseen_s > config_.unseen_land_s) land(now, fmt::format("no scan for {:.1f} s", unseen_s));
  const bool blind_holds = airborne && unseen_s > config_.unseen_hold_s;
  if (blind_holds != blind_holds_)
    say(now, blind_holds ? Severity::kWarning : Severity::kInfo, blind_holds ? "hold" : "scans are back",
        blind_holds ? fmt::format("no scan for {:.2f} s", unseen_s) : "");
  blind_holds_ = blind_holds;
}

void Supervisor::watchEnergy(Time now, const common::EnergyLayer& energy) {
  if (!control::isAirborne(flight_)) return;
  for (const double share : {0.3, 0.2}) {
    if (charge_said_ <= share || energy.battery_remaining > share) continue;
    charge_said_ = share;
    const std::string left =
        energy.seconds_left ? fmt::format("{:.1f} min until it lands", *energy.seconds_left / 60.0) : "";
    say(now, Severity::kWarning, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining), left);
  }
  if (energy.battery_remaining < config_.battery_land_share)
    land(now, fmt::format("{:.0f} % of the battery left", 100.0 * energy.battery_remaining));

  const bool weak = flight_ == common::FlightState::kFlying && energy.thrust_margin > 0.0 &&
                    energy.thrust_margin < config_.least_thrust_margin;
  if (!weak) weak_since_.reset();
  if (weak && !weak_since_) weak_since_ = now;
  if (weak && (now - *weak_since_).seconds() >= config_.thrust_margin_s)
    land(now, fmt::format("the thrust is at most {:.2f} times the weight", energy.thrust_margin));

  if (!energy.home_share || !home_reason_.empty() || flight_ != common::FlightState::kFlying) return;
  const double needed = config_.home_need_factor * *energy.home_share;
  const double land_share = std::max(config_.battery_land_share, energy.land_share);
  if (energy.battery_remaining - land_share - config_.home_reserve_share > needed) return;
  home_reason_ = fmt::format(
      "turned back with {:.0f} % of the battery left, {:.0f} % to fly {:.1f} m home, and {:.0f} % at which {}",
      100.0 * energy.battery_remaining, 100.0 * *energy.home_share, energy.home_m.value_or(0.0), 100.0 * land_share,
      land_share > config_.battery_land_share ? "the thrust carries the weight no longer" : "it lands");
  goes_home_ = true;
  operator_holds_ = false;
  ++flights_home_;
  say(now, Severity::kWarning, "turn back", home_reason_);
}

void Supervisor::watchPosition(Time now, const VehicleCondition& condition) {
  unknown_.clear();
  if (flight_ != common::FlightState::kFlying) {
    flies_back_ = false;
    return;
  }
  if (condition.vertical_age_s > config_.height_back_s && !blind_holds_)
    unknown_ = fmt::format("the surface below is not measured for {:.1f} s", condition.vertical_age_s);
  else if (condition.drift_m > config_.drift_back_m)
    unknown_ = fmt::format("the position is uncertain by {:.1f} m", condition.drift_m);
  if (condition.drift_m > config_.drift_land_m) land(now, unknown_);
  const bool known = condition.vertical_age_s < kSeen_s && condition.drift_m < kKnownShare * config_.drift_back_m;
  if (!known) known_since_.reset();
  if (known && !known_since_) known_since_ = now;
  if (!unknown_.empty() && !flies_back_) {
    flies_back_ = true;
    ++flights_back_;
    say(now, Severity::kWarning, "fly back along the trail", unknown_);
  } else if (flies_back_ && known && (now - *known_since_).seconds() >= config_.back_known_s) {
    flies_back_ = false;
    say(now, Severity::kInfo, "height and position are known again", "");
  }
}

/// Empty if nothing holds the mission.
std::string Supervisor::holdReason() const {
  if (pilot_flies_) return "the pilot flies";
  if (blind_holds_) return "the laser is silent";
  if (flies_back_) return "it flies back along its trail";
  if (goes_home_) return home_reason_.empty() ? "the operator wants it home" : home_reason_;
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
