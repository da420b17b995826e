// OperatorCommand: flies to the goals the operator gives, or home, and holds in between. It is RUNNING forever; a node
// above it must end the mission.
//
//   a new goal: replaces the present one
//   a goal that is not free: the nearest free place within a fingertip instead, with an event
//   a goal in the given map: followed when the localization moves the map; given up, then hold, when it loses the place
//   a goal is reached, or cannot be reached: an event, then hold
//   suspended and resumed: continues to its goal
//   halted: forgets its goal
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

  /// The goal with the tolerance and clearance of this node.
  common::GoToIntent goalTo(const common::GoalCommand& goal) const;

  /// The command that it flies to, or goes on with after a suspension.
  const std::optional<common::OperatorCommand>& present() const { return command_; }

 private:
  tree::Status act(tree::TickContext& context) override;
  void onStart(tree::TickContext& context) override;
  tree::Release onHalt(tree::TickContext& context) override;
  void take(FlightTick& tick);
  void finish(FlightTick& tick);
  void shift(FlightTick& tick);
  void followGivenMap(FlightTick& tick);

  tree::Input<double> tolerance_m_;
  tree::Input<double> clearance_m_;
  std::optional<common::OperatorCommand> command_;  ///< The present command; nullopt while it holds.
  std::optional<common::GoToIntent> goal_;
};

}  // namespace swiftlet::behaviors
