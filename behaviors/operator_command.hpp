// OperatorCommand: flies to the goals the operator gives, or home, and holds between. RUNNING for ever; whoever wants
// the mission to end says so from above it.
//   a new goal replaces the one under way
//   a goal reached, or one that cannot be reached: an event, then hold
//   suspended and resumed: goes on to the goal it had
#pragma once

#include <optional>
#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/event.hpp"

namespace swiftlet::behaviors {

class OperatorCommand final : public FlightLeaf {
 public:
  explicit OperatorCommand(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

  /// How it would fly to that place: with its tolerance and clearance.
  common::GoToIntent goalTo(const Eigen::Vector2d& place_map_m) const;

 private:
  tree::Status act(tree::TickContext& context) override;
  void onStart(tree::TickContext& context) override;
  void take(FlightTick& tick);
  void finish(FlightTick& tick);
  void say(FlightTick& tick, common::Severity severity, std::string text, std::string reason) const;

  tree::Input<double> tolerance_m_;
  tree::Input<double> clearance_m_;
  std::optional<common::OperatorCommand> command_;  ///< Under way; none: it holds.
  std::optional<common::GoToIntent> goal_;
};

}  // namespace swiftlet::behaviors
