// LocateTarget: flies to where the camera sees a target well, and looks at it from several sides until its place is
// known to `sigma_m`. SUCCESS then, with the camera on it; each success is about a new target.
// FAILURE when no other is known, or when looking from all sides was not enough.
//
//   choose the nearest --> fly to a free place to look from, facing it --> look --known well--> SUCCESS
//                               ^------------ from another side -------------/  \--no side left--> FAILURE
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/world/targets_layer.hpp"

namespace swiftlet::behaviors {

class LocateTarget final : public FlightLeaf {
 public:
  explicit LocateTarget(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  struct Ports {
    std::string name;
    double sigma_m, distance_m, clearance_m;
    common::FlightMode mode;
  };
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;
  tree::Status look(FlightTick& tick, const common::Target& target, const Ports& ports);
  /// The target's place is known: writes it.
  tree::Status located(tree::TickContext& context, const common::Target& target);
  std::string problemOfPorts() const;
  /// Where to look from next; nullopt: no side is left.
  std::optional<common::GoToIntent> nextView(const FlightTick& tick, const common::Target& target,
                                             const Ports& ports) const;

  tree::Input<std::string> name_;
  tree::Input<double> sigma_m_, distance_m_, clearance_m_;
  tree::Input<std::string> mode_;
  tree::Output place_, file_;

  int target_ = 0;                 ///< Id of the target; 0 while none is chosen.
  std::vector<double> sides_rad_;  ///< Bearings from the target of the places that were flown to.
  std::optional<common::GoToIntent> view_;
  std::optional<common::Time> looks_since_;  ///< When it was there.
};

}  // namespace swiftlet::behaviors
