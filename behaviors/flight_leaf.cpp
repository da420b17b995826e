#include "behaviors/flight_leaf.hpp"

#include <utility>

#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {

using tree::Release;
using tree::Status;

void FlightLeaf::emitIntent(FlightTick& tick, common::IntentKind kind) {
  if (intent_id_ == 0) intent_id_ = tick.newIntentId();
  hold_id_ = 0;
  tick.emit(intent_id_, std::move(kind), interrupted_id_);
}

void FlightLeaf::emitHold(FlightTick& tick) {
  if (hold_id_ == 0) hold_id_ = tick.newIntentId();
  if (intent_id_ != 0) interrupted_id_ = intent_id_;
  intent_id_ = 0;
  tick.emit(hold_id_, common::HoldIntent{});
}

common::IntentState FlightLeaf::intentState(const FlightTick& tick) const {
  const common::IntentStatus& status = tick.flight.status;
  return intent_id_ != 0 && status.id == intent_id_ ? status.state : common::IntentState::kRunning;
}

void FlightLeaf::onStart(tree::TickContext&) { intent_id_ = hold_id_ = interrupted_id_ = 0; }

void FlightLeaf::onResume(tree::TickContext&) { intent_id_ = hold_id_ = 0; }

Release FlightLeaf::onSuspend(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  emitHold(tick);
  return holdReleased(tick) || tick.flight.world->vehicle->avoidance.retreating ? Release::kReleased
                                                                                : Release::kLettingGo;
}

Release FlightLeaf::onHalt(tree::TickContext& context) { return onSuspend(context); }

void IntentLeaf::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  kind_.reset();
  ended_.reset();
}

void IntentLeaf::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  kind_.reset();
}

Release IntentLeaf::onSuspend(tree::TickContext& context) {
  const FlightTick& tick = flightTick(context);
  if (intentState(tick) != common::IntentState::kRunning) ended_ = tick.flight.status;
  return FlightLeaf::onSuspend(context);
}

Status IntentLeaf::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (const auto ended = std::exchange(ended_, std::nullopt)) return outcomeOf(context, ended->state, ended->reason);
  if (kind_ && isOutdated(tick)) {
    kind_.reset();
    renewIntent();
  }
  if (!kind_) {
    IntentOrProblem made = makeIntent(tick);
    if (!made) return fail(context, made.error());
    kind_ = *std::move(made);
  }
  emitIntent(tick, *kind_);
  return outcomeOf(context, intentState(tick), tick.flight.status.reason);
}

Status IntentLeaf::outcomeOf(tree::TickContext& context, common::IntentState state, const std::string& reason) {
  switch (state) {
    case common::IntentState::kRunning:
      return Status::kRunning;
    case common::IntentState::kSucceeded: {
      const std::string problem = problemWith(flightTick(context), reason);
      return problem.empty() ? Status::kSuccess : fail(context, problem);
    }
    case common::IntentState::kFailed:
      return fail(context, reason);
  }
  return Status::kRunning;
}

}  // namespace swiftlet::behaviors
