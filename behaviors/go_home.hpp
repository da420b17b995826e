// GoHome: SUCCESS when the vehicle is within tolerance_m of the take-off place. SLAM may correct that place in `map`
// during the flight; a correction of more than half the tolerance renews the intent.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class GoHome final : public IntentLeaf {
 public:
  explicit GoHome(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  bool isOutdated(const FlightTick& tick) const override;

  tree::Input<double> tolerance_m_;
  tree::Input<double> clearance_m_;
  common::GoToIntent made_;
};

}  // namespace swiftlet::behaviors
