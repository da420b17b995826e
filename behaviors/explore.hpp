// Explore: SUCCESS when every remaining frontier has a reason why it is left; lying outside `bounds` is such a reason.
#pragma once

#include "behaviors/explore_ports.hpp"
#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Explore final : public IntentLeaf {
 public:
  explicit Explore(const tree::NodeSetup& setup) : IntentLeaf(setup), ports_(setup) {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  ExplorePorts ports_;
};

}  // namespace swiftlet::behaviors
