#include "behaviors/operator_command.hpp"

#include <utility>

#include <fmt/format.h>

#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

std::string nameOf(const common::OperatorCommand& command, const FlightTick& tick) {
  return toString(command, tick.flight.world->map->names());
}

}  // namespace

tree::NodeManifest OperatorCommand::manifest() {
  return {.id = "OperatorCommand",
          .kind = tree::NodeKind::kAction,
          .ports = {tolerancePort(), clearancePort()},
          .description = "Flies to the goals the operator gives, or home, and holds between.",
          .ends = "never",
          .may_succeed = false,
          .traits = LeafTraits{.obeys_operator = true}};
}

OperatorCommand::OperatorCommand(const tree::NodeSetup& setup)
    : FlightLeaf(setup), tolerance_m_(setup, "tolerance_m"), clearance_m_(setup, "clearance_m") {}

void OperatorCommand::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  command_.reset();
  goal_.reset();
}

tree::Release OperatorCommand::onHalt(tree::TickContext& context) {
  command_.reset();
  goal_.reset();
  return FlightLeaf::onHalt(context);
}

tree::Status OperatorCommand::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (!tolerance_m_.get()) return fail(context, tolerance_m_.problem());
  if (!clearance_m_.get()) return fail(context, clearance_m_.problem());
  finish(tick);
  take(tick);
  followGivenMap(tick);
  if (goal_)
    emitIntent(tick, *goal_);
  else
    emitHold(tick);
  return tree::Status::kRunning;
}

void OperatorCommand::take(FlightTick& tick) {
  if (!tick.pending_command) return;
  const common::OperatorCommand next = *std::exchange(tick.pending_command, std::nullopt);
  if (command_)
    tick.say(common::Severity::kInfo, nameOf(*command_, tick) + " cancelled", "replaced by " + nameOf(next, tick));
  command_ = next;
  const auto* point = std::get_if<common::GoalCommand>(&next.kind);
  goal_ = goalTo(point != nullptr ? *point : common::GoalCommand{tick.flight.world->vehicle->home_map.position_m()});
  goal_->mode = tick.mode;
  if (point != nullptr)
    shift(tick);
  else
    goal_->shift_m = common::kHomeShift_m;
  renewIntent();
}

/// The mission has accepted the goal. Where it is not free, a place beside it is. The map may refuse either a moment
/// later, so that again a place beside it will do.
void OperatorCommand::shift(FlightTick& tick) {
  const common::Goal tapped = common::tappedGoalOf(*goal_);
  const auto place = common::judgeGoal(tapped, tick.flight.goal_limits, tick.flight.goal_map.get());
  const double off_m = place ? (*place - goal_->goal_map_m).norm() : 0.0;
  goal_->shift_m = tapped.shift_m;
  if (off_m <= goal_->tolerance_m) return;
  tick.say(common::Severity::kInfo, nameOf(*command_, tick) + fmt::format(" shifted by {:.2f} m", off_m),
           "to " + tick.flight.world->map->names().of(*place) + ", the nearest free place");
  goal_->goal_map_m = *place;
}

void OperatorCommand::followGivenMap(FlightTick& tick) {
  if (!goal_ || !hasMoved(*goal_, *tick.flight.world)) return;
  const auto places = NamedPlaces::in(*tick.flight.world);
  renewIntent();
  if (places) {
    goal_->goal_map_m = places->inMap_m(*goal_->goal_given_m);
    return;
  }
  tick.say(common::Severity::kWarning, nameOf(*command_, tick) + " cancelled", places.error());
  command_.reset();
  goal_.reset();
}

/// Checks the present goal before a new one replaces it, so that a goal that was reached is reported as reached.
void OperatorCommand::finish(FlightTick& tick) {
  if (!command_) return;
  switch (intentState(tick)) {
    case common::IntentState::kRunning:
      return;
    case common::IntentState::kSucceeded:
      tick.say(common::Severity::kInfo, nameOf(*command_, tick) + " reached", {});
      break;
    case common::IntentState::kFailed:
      tick.say(common::Severity::kWarning, nameOf(*command_, tick) + " not reached", tick.flight.status.reason);
      break;
  }
  command_.reset();
  goal_.reset();
}

common::GoToIntent OperatorCommand::goalTo(const common::GoalCommand& goal) const {
  common::GoToIntent intent;
  intent.goal_map_m = goal.goal_map_m;
  intent.goal_given_m = goal.goal_given_m;
  intent.tolerance_m = tolerance_m_.get().value_or(intent.tolerance_m);
  intent.clearance_m = clearance_m_.get().value_or(intent.clearance_m);
  return intent;
}

}  // namespace swiftlet::behaviors
