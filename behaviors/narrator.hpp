// Tells what happens in the tree as events of the mission.
#pragma once

#include <string>

#include "behaviors/context.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

class Narrator final : public tree::Observer {
 public:
  explicit Narrator(const tree::Tree& tree) : tree_(tree) {}

  /// Where the events of this tick go; null between ticks.
  void listen(Context* context) { context_ = context; }
  /// The newest failure: "MoveToGoal: no path".
  const std::string& failure() const { return failure_; }

  void onStatus(const tree::Node& node, tree::Status from, tree::Status to) override;
  void onSwitch(const tree::Switch& change) override;
  void onFailure(const tree::Node& node, std::string_view reason) override;

 private:
  bool isToldBySwitches(const tree::Node& node) const;
  void say(common::Severity severity, std::string text, std::string reason);

  const tree::Tree& tree_;
  Context* context_ = nullptr;
  std::string failure_;
  int failed_node_ = -1;
  std::string failure_reason_;
};

}  // namespace swiftlet::behaviors
