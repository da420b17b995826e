// TurnTo: SUCCESS when the vehicle, staying where it is, looks along yaw_deg in `map`, or in the given map.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

class TurnTo final : public IntentLeaf {
 public:
  explicit TurnTo(const tree::NodeSetup& setup) : IntentLeaf(setup), yaw_deg_(setup, "yaw_deg") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<double> yaw_deg_;
};

tree::NodeManifest TurnTo::manifest() {
  return {.id = "TurnTo",
          .kind = tree::NodeKind::kAction,
          .ports = {headingPort(true)},
          .description = "Turns on the spot.",
          .ends = "SUCCESS when it looks there"};
}

IntentLeaf::IntentOrProblem TurnTo::makeIntent(const FlightTick& tick) {
  const auto yaw_deg = yaw_deg_.get();
  if (!yaw_deg) return tl::unexpected(yaw_deg_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  common::GoToIntent intent;
  intent.goal_map_m = tick.flight.world->vehicle->state.T_map_body_planar().position_m();
  intent.yaw_map_rad = places->yawInMap_rad(*yaw_deg);
  intent.mode = tick.mode;
  intent.tolerance_m = 0.15;  // A gust may push the vehicle while it turns.
  intent.clearance_m = 0.0;   // It stands here already.
  return intent;
}

}  // namespace

void addTurnTo(tree::Registry& registry) { registry.add<TurnTo>(); }

}  // namespace swiftlet::behaviors
