// Tells what happens in the tree as events of the mission.
#pragma once

#include <string>
#include <vector>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

class Narrator final : public tree::Observer {
 public:
  explicit Narrator(const tree::Tree& tree) : tree_(tree) {}

  /// The tick whose events are told, into its flight's; null between ticks.
  void listen(FlightTick* tick) { tick_ = tick; }
  /// Why the tree fails, the first cause first: "MoveToGoal: no path", or "MoveToGoal: no path, and then GoHome: the
  /// goal is unreachable". Empty when nothing has failed, or what did was made good for by a node above it.
  std::string failure() const;
  /// The mission begins anew.
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
  bool isToldBySwitches(const tree::Node& node) const;
  void say(common::Severity severity, std::string text, std::string reason);

  const tree::Tree& tree_;
  FlightTick* tick_ = nullptr;
  std::vector<Failure> failures_;  ///< In the order they came.
  int failed_node_ = -1;
  std::string failure_reason_;
};

}  // namespace swiftlet::behaviors
