// Delay: waits delay_msec (RUNNING), then has the status of the child. The clock starts at the first tick and stands
// still from the tick that suspends this node to the one that resumes it. The child is asked only when the time is
// over. Until then the Delay is active, whatever the child would answer.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/stopwatch.hpp"

namespace swiftlet::tree {

class Delay final : public Composite {
 public:
  explicit Delay(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext& context) override { watch_.restart(context.now_ns); }
  void onResume(TickContext& context) override { watch_.resume(context.now_ns); }
  Release onSuspend(TickContext& context) override;
  bool onAsked(const TickContext& context) const override;

  Input<Duration> delay_msec_;
  Stopwatch watch_;
};

}  // namespace swiftlet::tree
