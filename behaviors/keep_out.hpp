// KeepOut: the vehicle keeps out of `polygon` for the rest of the flight, whatever it does: planning, exploring, flying
// home, and braking. SUCCESS when that holds; FAILURE for a polygon that cannot be kept out of, or whose
// place in the given map is not known. It stays where it was made, also if the localization moves the given map.
#pragma once

#include "behaviors/request_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class KeepOut final : public RequestLeaf {
 public:
  explicit KeepOut(const tree::NodeSetup& setup) : RequestLeaf(setup), polygon_(setup, "polygon") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<tree::Points> polygon_;
};

}  // namespace swiftlet::behaviors
