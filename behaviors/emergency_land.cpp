// EmergencyLand: descends at once where the vehicle is, by the raw height alone, and switches the motors off. SUCCESS
// on the ground. It cannot be revoked: a release does not end the descent.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"

namespace swiftlet::behaviors {
namespace {

class EmergencyLand final : public IntentLeaf {
 public:
  using IntentLeaf::IntentLeaf;
  static tree::NodeManifest manifest() {
    return {.id = "EmergencyLand",
            .kind = tree::NodeKind::kAction,
            .ports = {},
            .description = "Descends at once where it is, without the position.",
            .details = "By the raw height alone; then it switches the motors off. It cannot be taken back.",
            .ends = "SUCCESS when it stands",
            .traits = LeafTraits{.vehicle = VehicleUse::kLands}};
  }

 private:
  IntentOrProblem makeIntent(const FlightTick&) override { return common::EmergencyLandIntent{}; }
};

}  // namespace

void addEmergencyLand(tree::Registry& registry) { registry.add<EmergencyLand>(); }

}  // namespace swiftlet::behaviors
