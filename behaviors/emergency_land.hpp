// EmergencyLand: descends at once where the vehicle is, by the raw height alone, and switches the motors off. SUCCESS
// on the ground. It cannot be revoked: a release does not end the descent.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

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

}  // namespace swiftlet::behaviors
