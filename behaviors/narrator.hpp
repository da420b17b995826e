// Reports what happens in the tree as events of the mission.
#pragma once

#include <string>
#include <vector>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

class Narrator final : public tree::Observer {
 public:
  explicit Narrator(const tree::Tree& tree) : tree_(tree) {}

  /// The tick whose events are reported, into its flight's list; null between ticks.
  void listen(FlightTick* tick) { tick_ = tick; }
  /// Why the tree fails, the first cause first, with the paths of the nodes: "MoveToGoal: no path [M/MoveToGoal]", or
  /// "MoveToGoal: no path [M/MoveToGoal], and then GoHome: the goal is unreachable [M/GoHome]". Empty if nothing has
  /// failed, or if a node above the failure recovered from it.
  std::string failure() const;
  /// Call when the mission is reset.
  void forget() { failures_.clear(); }

  void onStatus(const tree::Node& node, tree::Status from, tree::Status to) override;
  void onSwitch(const tree::Switch& change) override;
  void onFailure(const tree::Node& node, std::string_view reason) override;

 private:
  struct Failure {
    int node = -1;
    std::string text;
  };

  void forgiveBelow(const tree::Node& node);
  bool isCondition(const tree::Node& node) const;
  bool isReportedBySwitches(const tree::Node& node) const;
  void say(common::Severity severity, std::string text, std::string reason);

  const tree::Tree& tree_;
  FlightTick* tick_ = nullptr;
  std::vector<Failure> failures_;  ///< Failures in the order of time.
  int failed_node_ = -1;
  std::string failure_reason_;
};

}  // namespace swiftlet::behaviors
