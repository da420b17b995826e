// Localize: SUCCESS as soon as the vehicle knows where it is in the map it was given; explores until then. FAILURE when
// there is no such map, or nothing is left to explore.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Localize final : public FlightLeaf {
 public:
  explicit Localize(const tree::NodeSetup& setup) : FlightLeaf(setup), clearance_m_(setup, "clearance_m") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<double> clearance_m_;
};

}  // namespace swiftlet::behaviors
