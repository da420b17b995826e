// Hold: active while the operator holds or an emergency does; SKIPPED otherwise, SUCCESS when the hold ends.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class Hold final : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;
  static tree::NodeManifest manifest();

 private:
  std::string whyItWants(const tree::TickContext& context) const override;
  bool onAsked(const tree::TickContext& context) const override { return flightTick(context).flight.hold; }
  tree::Status act(tree::TickContext& context) override;
};

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

}  // namespace

void addHold(tree::Registry& registry) { registry.add<Hold>(); }

}  // namespace swiftlet::behaviors
