#include "behaviors/flight_leaf.hpp"

#include <utility>

#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {

using tree::Release;
using tree::Status;

void FlightLeaf::wish(FlightTick& tick, common::IntentKind kind) {
  if (wish_id_ == 0) wish_id_ = tick.newIntentId();
  hold_id_ = 0;
  tick.emit(wish_id_, std::move(kind));
}

void FlightLeaf::wishHold(FlightTick& tick) {
  if (hold_id_ == 0) hold_id_ = tick.newIntentId();
  wish_id_ = 0;
  tick.emit(hold_id_, common::HoldIntent{});
}

common::IntentState FlightLeaf::wishState(const FlightTick& tick) const {
  const common::IntentStatus& status = tick.flight.status;
  return wish_id_ != 0 && status.id == wish_id_ ? status.state : common::IntentState::kRunning;
}

void FlightLeaf::onStart(tree::TickContext&) { wish_id_ = hold_id_ = 0; }

void FlightLeaf::onResume(tree::TickContext&) { wish_id_ = hold_id_ = 0; }

Release FlightLeaf::onSuspend(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  wishHold(tick);
  const bool stopped = tick.flight.status.id == hold_id_ && tick.flight.status.released;
  return stopped || tick.flight.world->vehicle->avoidance.retreating ? Release::kReleased : Release::kLettingGo;
}

Release FlightLeaf::onHalt(tree::TickContext& context) { return onSuspend(context); }

void IntentLeaf::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  kind_.reset();
}

void IntentLeaf::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  kind_.reset();
}

Status IntentLeaf::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (kind_ && isOutdated(tick)) {
    kind_.reset();
    renewWish();
  }
  if (!kind_) {
    Wish made = makeWish(tick);
    if (!made.kind) return fail(context, made.problem);
    kind_ = std::move(made.kind);
  }
  wish(tick, *kind_);
  switch (wishState(tick)) {
    case common::IntentState::kRunning:
      return Status::kRunning;
    case common::IntentState::kSucceeded:
      return Status::kSuccess;
    case common::IntentState::kFailed:
      return fail(context, tick.flight.status.reason);
  }
  return Status::kRunning;
}

}  // namespace swiftlet::behaviors
