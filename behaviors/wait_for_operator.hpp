// WaitForOperator: waits until the operator says "go on", which is SUCCESS; FAILURE after `timeout_s`. It has no
// intent: in flight the vehicle holds where it is. The time of a suspension does not count.
#pragma once

#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class WaitForOperator final : public tree::Leaf {
 public:
  explicit WaitForOperator(const tree::NodeSetup& setup)
      : Leaf(setup), question_(setup, "question"), timeout_s_(setup, "timeout_s") {}
  static tree::NodeManifest manifest();

  /// What it waits for; empty while it does not wait.
  std::string question() const;

 private:
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;

  tree::Input<std::string> question_;
  tree::Input<tree::Duration> timeout_s_;
  common::Duration waited_;
  common::Time last_tick_;
};

}  // namespace swiftlet::behaviors
