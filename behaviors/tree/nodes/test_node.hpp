// TestNode: a stand-in for a leaf, to try a tree out. It is RUNNING for async_delay_msec, runs its scripts and answers
// return_status.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/script/script.hpp"
#include "behaviors/tree/stopwatch.hpp"

namespace swiftlet::tree {

class TestNode final : public Leaf {
 public:
  explicit TestNode(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status act(TickContext& context) override;
  void onStart(TickContext& context) override { watch_.restart(context.now_ns); }
  void onResume(TickContext& context) override { watch_.resume(context.now_ns); }
  Release onSuspend(TickContext& context) override;
  bool onAsked(const TickContext&) const override;
  bool run(TickContext& context, Script* script) const;

  Input<std::string> return_status_;
  Input<Duration> async_delay_msec_;
  Script *success_script_, *failure_script_, *post_script_;  ///< Null where not given.
  Stopwatch watch_;
};

}  // namespace swiftlet::tree
