// AvoidObstacle: active in flight while the reactive layer retreats from something unmapped or closing.
// SKIPPED otherwise, SUCCESS when the danger is over. The layer itself acts at the laser rate under every intent; this
// node stays active for it, so that no other intent works against the retreat. [UNB III-A, Fig. 5]
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

class AvoidObstacle final : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;
  static tree::NodeManifest manifest();

 private:
  std::string whyItWants(const tree::TickContext& context) const override;
  bool onAsked(const tree::TickContext& context) const override;
  tree::Status act(tree::TickContext& context) override;
};

tree::NodeManifest AvoidObstacle::manifest() {
  return {
      .id = "AvoidObstacle",
      .kind = tree::NodeKind::kAction,
      .ports = {},
      .description = "Gives the vehicle to the reactive layer while that retreats from an obstacle; skipped otherwise.",
      .details = "In flight only.",
      .ends = "SUCCESS when the danger is over",
      .may_skip = true};
}

std::string AvoidObstacle::whyItWants(const tree::TickContext& context) const {
  const std::string& reason = flightTick(context).flight.world->vehicle->avoidance.reason;
  return reason.empty() ? "the reactive layer retreats" : reason;
}

bool AvoidObstacle::onAsked(const tree::TickContext& context) const {
  const common::VehicleLayer& vehicle = *flightTick(context).flight.world->vehicle;
  return vehicle.flight_state == common::FlightState::kFlying && vehicle.avoidance.retreating;
}

tree::Status AvoidObstacle::act(tree::TickContext& context) {
  if (!onAsked(context)) return tree::Status::kSuccess;
  emitIntent(flightTick(context), common::AvoidIntent{});
  return tree::Status::kRunning;
}

}  // namespace

void addAvoidObstacle(tree::Registry& registry) { registry.add<AvoidObstacle>(); }

}  // namespace swiftlet::behaviors
