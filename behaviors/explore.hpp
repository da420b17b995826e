// Explore: SUCCESS when every remaining frontier has a reason why it is left; lying outside `bounds` is such a reason.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Explore final : public IntentLeaf {
 public:
  explicit Explore(const tree::NodeSetup& setup)
      : IntentLeaf(setup),
        clearance_m_(setup, "clearance_m"),
        bounds_(setup, "bounds"),
        leave_building_(setup, "leave_building") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<double> clearance_m_;
  tree::Input<tree::Rectangle> bounds_;
  tree::Input<bool> leave_building_;
};

}  // namespace swiftlet::behaviors
