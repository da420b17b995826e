// Localize: explores until the vehicle is localized in the given map, which is SUCCESS. FAILURE if there is no such
// map, if it is found to be that of another place, or if nothing is left to explore.
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
