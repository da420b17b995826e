#include "autonomy/supervisor.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Severity;
using common::Time;

std::string_view phaseOf(const Supervision& supervision) {
  if (supervision.land) return "land";
  if (supervision.back > 0) return "fly back along the trail";
  if (supervision.home > 0) return "fly home";
  return supervision.hold ? "hold" : "";
}

std::optional<common::CommandResult> Supervisor::take(const common::OperatorCommand& command, Time now) {
  const common::CommandResult accepted{command.id, true, {}};
  if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    operator_holds_ = true;
    home_.active = home_.forced();  // A flight home for the charge continues after Resume.
    return accepted;
  }
  if (std::holds_alternative<common::ResumeCommand>(command.kind)) return resume(command.id);
  if (std::holds_alternative<common::LandCommand>(command.kind)) {
    if (!supervision_.land) landed_by_operator_ = true;
    land(now, "the operator asked for it", common::Concern::kNone);
    return accepted;
  }
  return std::nullopt;
}

common::CommandResult Supervisor::resume(std::uint64_t id) {
  const bool held = std::exchange(operator_holds_, false);
  if (home_.forced()) return {id, held, "it flies home: " + home_.reason};
  if (!held && !home_.active) {
    const std::string reason = holdReason();
    return {id, false, reason.empty() ? "nothing is on hold" : reason + ": that hold ends by itself"};
  }
  home_.active = false;
  return {id, true, {}};
}

common::CommandResult Supervisor::goHome(const common::OperatorCommand& command, AtHome then) {
  if (flight_ != common::FlightState::kFlying)
    return {command.id, false, fmt::format("the vehicle is not flying: {}", common::toString(flight_))};
  startHome(home_.reason, then);
  return {command.id, true,
          then == AtHome::kHold ? "the mission holds meanwhile, and goes on after Resume"
                                : "the vehicle holds there until a mission is started"};
}

void Supervisor::startHome(std::string reason, AtHome then) {
  home_ = {true, std::move(reason), home_.count + 1, then};
  operator_holds_ = false;
}

void Supervisor::homeEnded(Time now, bool reached, std::string reason) {
  home_.active = false;
  if (!home_.reason.empty())
    return land(now, reached ? "home again, " + home_.reason : home_.reason + "; home not reached: " + reason);
  operator_holds_ = home_.then == AtHome::kHold;
  const std::string holds = operator_holds_ ? "the vehicle holds until Resume or Land"
                                            : "the vehicle holds until a mission is started, or it lands";
  say(now, reached ? Severity::kInfo : Severity::kWarning, reached ? "home reached" : "home not reached",
      reached ? holds : std::move(reason), reached ? common::Concern::kNone : common::Concern::kHome);
}

std::string Supervisor::refusal(const common::OperatorCommand& command) const {
  if (!control::isAirborne(flight_) || std::holds_alternative<common::LandCommand>(command.kind)) return {};
  if (supervision_.land) return "the vehicle is landing: " + supervision_.land_reason;
  if (flight_ == common::FlightState::kLanding || flight_ == common::FlightState::kEmergencyLanding)
    return "the vehicle is landing";
  const bool leads_elsewhere = std::holds_alternative<common::GoalCommand>(command.kind) ||
                               std::holds_alternative<common::HomeCommand>(command.kind) ||
                               std::holds_alternative<common::StartMissionCommand>(command.kind);
  return home_.forced() && leads_elsewhere ? "the vehicle flies home and lands there: " + home_.reason : "";
}

void Supervisor::pilotArrived(Time now, bool takes_over) {
  pilot_heard_ = now;
  if (takes_over == pilot_flies_) return;
  pilot_flies_ = takes_over;
  say(now, Severity::kWarning, takes_over ? "hold" : "resume",
      takes_over ? "the pilot took over" : "the pilot gave control back", common::Concern::kPilot);
}

/// After the pilot's last sample it is unknown who flies. A hold is right for both: a pilot's sticks override it, and
/// without a pilot the vehicle stays where it is, instead of going on with the mission that the pilot took it from.
void Supervisor::watchPilot(Time now) {
  if (!pilot_flies_ || (now - pilot_heard_).seconds() <= pilot_silent_s_) return;
  pilot_flies_ = false;
  operator_holds_ = true;
  say(now, Severity::kWarning, "hold",
      fmt::format("the pilot has not been heard of for {:.1f} s; it holds until Resume or Land", pilot_silent_s_),
      common::Concern::kPilot);
}

const Supervision& Supervisor::tick(Time now, const VehicleCondition& condition) {
  flight_ = condition.flight;
  watchPilot(now);
  blind_ = obey(now, sight_.watch(now, condition)).hold;
  if (control::isAirborne(flight_) && !condition.sensor_lies.empty()) land(now, condition.sensor_lies);
  obey(now, energy_.watch(now, condition));
  back_ = supervision_.land ? 0 : obey(now, position_.watch(now, condition, !blind_.empty())).back;

  supervision_.unseen = !blind_.empty();
  supervision_.hold_reason = holdReason();
  supervision_.hold = !supervision_.hold_reason.empty();
  const bool may_fly = blind_.empty() && !pilot_flies_;
  supervision_.back = may_fly && !operator_holds_ ? back_ : 0;
  supervision_.home = home_.active && may_fly && !operator_holds_ && back_ == 0 ? home_.count : 0;
  supervision_.flown_by = flownBy();
  return supervision_;
}

void Supervisor::backEnded(Time now) { back_ = obey(now, position_.backEnded()).back; }

WatchRequest Supervisor::obey(Time now, WatchRequest request) {
  for (common::Event& event : std::exchange(request.events, {})) events_.push_back(std::move(event));
  if (!request.home.empty()) startHome(request.home);
  if (!request.land.empty()) land(now, request.land);
  return request;
}

std::string Supervisor::holdReason() const {
  if (pilot_flies_) return "the pilot flies";
  if (!blind_.empty()) return blind_;
  if (operator_holds_)
    return back_ > 0 ? "the operator holds, and it would fly back along its trail" : "the operator holds";
  if (back_ > 0) return "it flies back along its trail";
  if (home_.active) return home_.reason.empty() ? "the operator wants it home" : home_.reason;
  return "";
}

/// In the order of holdReason().
common::FlownBy Supervisor::flownBy() const {
  if (supervision_.land) return landed_by_operator_ ? common::FlownBy::kOperator : common::FlownBy::kSupervisor;
  if (pilot_flies_) return common::FlownBy::kPilot;
  if (!blind_.empty()) return common::FlownBy::kSupervisor;
  if (operator_holds_) return common::FlownBy::kOperator;
  if (back_ > 0 || home_.forced()) return common::FlownBy::kSupervisor;
  return home_.active ? common::FlownBy::kOperator : common::FlownBy::kMission;
}

std::vector<common::Event> Supervisor::takeEvents() { return std::exchange(events_, {}); }

void Supervisor::land(Time now, std::string reason, common::Concern concern) {
  if (supervision_.land) return;
  supervision_.land = true;
  supervision_.land_reason = reason;
  say(now, Severity::kWarning, "land", std::move(reason), concern);
}

void Supervisor::say(Time now, Severity severity, std::string text, std::string reason, common::Concern concern) {
  events_.push_back({now, severity, "supervisor", std::move(text), std::move(reason), {}, concern});
}

}  // namespace swiftlet::autonomy
