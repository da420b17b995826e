// What operator and pilot want: the part of the autonomy that hears them.
#include <string>
#include <utility>

#include "autonomy/autonomy.hpp"
#include "common/mission_request.hpp"
#include "control/controller_choice.hpp"

namespace swiftlet::autonomy {

using common::Time;

void Autonomy::take(const common::OperatorCommand& command, Time now) {
  if (!std::holds_alternative<common::LandCommand>(command.kind)) {
    std::string refusal = supervisor_.refusal();
    if (refusal.empty() && missionOver()) refusal = "the mission has ended";
    if (!refusal.empty()) return answer(command, {command.id, false, std::move(refusal)}, now);
  }
  if (auto result = missions_.take(command)) return answer(command, std::move(*result), now);
  if (const auto* other = std::get_if<common::ControllerCommand>(&command.kind))
    return answer(command, switchController(command.id, *other), now);
  if (auto result = supervisor_.take(command, now)) {
    const auto next = missions_.mission().waitingCommand();
    if (result->accepted && next && std::holds_alternative<common::ResumeCommand>(command.kind))
      result->reason = "next: " + toString(*next);
    return answer(command, std::move(*result), now);
  }
  if (auto result = requests_.take(command, *world_)) return answer(command, std::move(*result), now);
  if (std::holds_alternative<common::HomeCommand>(command.kind) && !missions_.mission().acceptsGoals())
    return answer(command, supervisor_.goHome(command), now);
  context_.commands.push_back(command);
}

common::CommandResult Autonomy::switchController(std::uint64_t id, const common::ControllerCommand& command) {
  const auto kind = control::controllerNamed(command.controller);
  if (!kind) return {id, false, "there is no controller of that name"};
  const auto switched = controller_.switchController(*kind);
  return {id, switched.has_value(), switched ? std::string() : switched.error()};
}

/// Every command leaves an event, whether it was accepted or refused.
void Autonomy::answer(const common::OperatorCommand& command, common::CommandResult result, Time now) {
  events_.push_back({now, result.accepted ? common::Severity::kInfo : common::Severity::kWarning, "operator",
                     toString(command) + (result.accepted ? " accepted" : " refused"), result.reason});
  results_.push_back(std::move(result));
}

/// The pilot flies, and the program with him: it has the controller, but not the last word.
void Autonomy::assistPilot(control::FlightTick& flight) {
  const bool before = std::exchange(assisted_, assist_.assists(controller_.state(), flight.state));
  if (before && !assisted_) controller_.hold();
  if (!assisted_) return;
  flight.thrust_applies = assist_.thrustApplies(last_thrust_);
  flight.pilot_flies =
      !assist_.fly(controller_, reactive_.decision(), flight.state, context_.goal_limits.greatest_height_m);
}

}  // namespace swiftlet::autonomy
