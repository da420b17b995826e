// GoHome: SUCCESS when the vehicle is within tolerance_m of the take-off place. Where that is in `map` may be corrected
// in flight; a correction of more than half the tolerance renews the wish.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class GoHome final : public IntentLeaf {
 public:
  explicit GoHome(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  Wish makeWish(const FlightTick& tick) override;
  bool isOutdated(const FlightTick& tick) const override;

  tree::Input<double> tolerance_m_;
  tree::Input<double> clearance_m_;
  common::GoToIntent made_;
};

}  // namespace swiftlet::behaviors
