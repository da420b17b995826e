// What operator and pilot want: the part of the autonomy that hears them.
#include <string>
#include <utility>

#include "autonomy/autonomy.hpp"
#include "behaviors/named_places.hpp"
#include "control/controller_choice.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Time;

void Autonomy::take(const common::OperatorCommand& asked, Time now) {
  common::OperatorCommand command = asked;
  std::string refusal = supervisor_.refusal(command);
  const bool lands = std::holds_alternative<common::LandCommand>(command.kind);
  if (refusal.empty() && missionOver() && !lands) refusal = "the mission has ended";
  if (refusal.empty()) refusal = resolvePlaces(command);
  if (!refusal.empty()) return answer(command, {command.id, false, std::move(refusal)}, now);
  if (auto result = takeMission(command)) return answer(command, std::move(*result), now);
  if (const auto* other = std::get_if<common::ControllerCommand>(&command.kind))
    return answer(command, switchController(command.id, *other), now);
  if (auto result = supervisor_.take(command, now)) {
    const auto next = missions_.waitingCommand();
    if (result->accepted && next && std::holds_alternative<common::ResumeCommand>(command.kind))
      result->reason = "next: " + toString(*next, world_->map->names());
    return answer(command, std::move(*result), now);
  }
  if (auto result = requests_.take(command, *world_)) return answer(command, std::move(*result), now);
  if (std::holds_alternative<common::HomeCommand>(command.kind)) {
    if (missions_.noneFollows()) return answer(command, supervisor_.goHome(command, AtHome::kWaitForMission), now);
    if (!missions_.mission().acceptsGoals()) return answer(command, supervisor_.goHome(command), now);
  }
  context_.commands.push_back(command);
}

/// Places in the given map get their places in `map`; or why they have none. Empty if all have.
std::string Autonomy::resolvePlaces(common::OperatorCommand& command) const {
  auto* goal = std::get_if<common::GoalCommand>(&command.kind);
  auto* zone = std::get_if<common::KeepOutCommand>(&command.kind);
  const bool goal_given = goal != nullptr && goal->goal_given_m;
  const bool zone_given = zone != nullptr && !zone->corners_given_m.empty();
  if (!goal_given && !zone_given) return {};
  const auto places = behaviors::NamedPlaces::in(*world_);
  if (!places) return places.error();
  if (!places->given()) return "the flight was given no map";
  if (goal_given) goal->goal_map_m = places->inMap_m(*goal->goal_given_m);
  if (!zone_given) return {};
  zone->area.corners_map_m.clear();
  for (const Eigen::Vector2d& corner_given_m : zone->corners_given_m)
    zone->area.corners_map_m.push_back(places->inMap_m(corner_given_m));
  return {};
}

/// The maps of a mission that is refused are not kept.
std::optional<common::CommandResult> Autonomy::takeMission(const common::OperatorCommand& command) {
  const auto* mission = std::get_if<common::StartMissionCommand>(&command.kind);
  if (mission == nullptr) {
    auto result = missions_.take(command);
    if (result && result->accepted && !control::isAirborne(controller_.state()))
      result->reason = "the vehicle stays on the ground until a mission is started";
    return result;
  }
  const MapShelf before = map_shelf_;
  map_shelf_.offer(mission->maps);
  auto result = missions_.take(command);
  if (!result->accepted)
    map_shelf_ = before;
  else if (const std::string hold = supervisor_.holdReason(); !hold.empty())
    result->reason += (result->reason.empty() ? "" : ", ") + behaviors::flownAfterHold(hold);
  return result;
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
                     toString(command, world_->map->names()) + (result.accepted ? " accepted" : " refused"),
                     result.reason});
  results_.push_back(std::move(result));
}

/// The pilot flies, and the program with the pilot: it has the controller, but not the last word.
void Autonomy::assistPilot(control::FlightTick& flight) {
  const bool before = std::exchange(assisted_, assist_.assists(flight.pilot_flies, controller_.state(), flight.state));
  if (before && !assisted_) controller_.hold();
  if (!assisted_) return;
  flight.thrust_applies = assist_.thrustApplies(last_thrust_);
  // What the laser saw last is no longer so: without it the program asks for a stop.
  const planning::AvoidanceDecision& decision =
      supervisor_.seesNothing() ? planning::AvoidanceDecision() : reactive_.decision();
  flight.pilot_flies = !assist_.fly(controller_, decision, flight.state, context_.goal_limits.greatest_height_m);
}

}  // namespace swiftlet::autonomy
