// TakeOff: SUCCESS when the vehicle hovers at height_m above the take-off floor.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class TakeOff final : public IntentLeaf {
 public:
  explicit TakeOff(const tree::NodeSetup& setup) : IntentLeaf(setup), height_m_(setup, "height_m") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<double> height_m_;
};

}  // namespace swiftlet::behaviors
