#include "behaviors/hold.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Hold::manifest() {
  return {.id = "Hold",
          .kind = tree::NodeKind::kAction,
          .ports = {},
          .description = "Stays where it is while the operator holds or an emergency does; skipped otherwise.",
          .ends = "SUCCESS when the hold ends",
          .may_skip = true};
}

std::string Hold::whyItWants(const tree::TickContext& context) const {
  const std::string& reason = flightTick(context).flight.hold_reason;
  return reason.empty() ? "the operator holds" : reason;
}

tree::Status Hold::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (!tick.flight.hold) return tree::Status::kSuccess;
  emitHold(tick);
  return tree::Status::kRunning;
}

}  // namespace swiftlet::behaviors
