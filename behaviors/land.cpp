// Land: SUCCESS when the vehicle stands on the floor.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"

namespace swiftlet::behaviors {
namespace {

class Land final : public IntentLeaf {
 public:
  using IntentLeaf::IntentLeaf;
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick&) override { return common::LandIntent{}; }
};

tree::NodeManifest Land::manifest() {
  return {.id = "Land",
          .kind = tree::NodeKind::kAction,
          .ports = {},
          .description = "Descends and stops, at the nearest place where the hull stands on one level.",
          .details =
              "The place is within 4 m, on the mapped surfaces and clear of edges; where its trail ends it first looks "
              "0.6 m beyond. Within 0.5 m of where it took off it lands there; where it is if no such place is known. "
              "A second later the motors are off, unless a TakeOff follows.",
          .ends = "SUCCESS when it stands",
          .traits = LeafTraits{.vehicle = VehicleUse::kLands}};
}

}  // namespace

void addLand(tree::Registry& registry) { registry.add<Land>(); }

}  // namespace swiftlet::behaviors
