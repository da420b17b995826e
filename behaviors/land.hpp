// Land: SUCCESS when the vehicle stands on the floor.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Land final : public IntentLeaf {
 public:
  using IntentLeaf::IntentLeaf;
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick&) override { return common::LandIntent{}; }
};

}  // namespace swiftlet::behaviors
