// MoveToGoal: SUCCESS when the vehicle is within tolerance_m of `goal` (in `map`: x;y at the present height or at
// `height_m`, or x;y;z with z above the take-off floor) and, where `yaw_deg` is given, looks there. In a flight that
// was given a map, both are those of that map, and FAILURE while the vehicle is not localized in it.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/go_to_ports.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class MoveToGoal final : public IntentLeaf {
 public:
  explicit MoveToGoal(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  bool isOutdated(const FlightTick& tick) const override;
  tree::Input<tree::Point> goal_;
  GoToPorts go_to_;
  tree::Input<double> height_m_;
  tree::Input<double> yaw_deg_;
  common::GoToIntent emitted_;  ///< The present intent.
};

}  // namespace swiftlet::behaviors
