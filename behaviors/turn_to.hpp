// TurnTo: SUCCESS when the vehicle, staying where it is, looks along yaw_deg in `map`, or in the given map.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class TurnTo final : public IntentLeaf {
 public:
  explicit TurnTo(const tree::NodeSetup& setup) : IntentLeaf(setup), yaw_deg_(setup, "yaw_deg") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<double> yaw_deg_;
};

}  // namespace swiftlet::behaviors
