// Sleep: RUNNING for msec, then SUCCESS. The clock starts at the first tick and stands still while it is suspended.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/stopwatch.hpp"

namespace swiftlet::tree {

class Sleep final : public Leaf {
 public:
  explicit Sleep(const NodeSetup& setup) : Leaf(setup), msec_(setup, "msec") {}
  static NodeManifest manifest();

 private:
  Status act(TickContext& context) override;
  void onStart(TickContext& context) override { watch_.restart(context.now_ns); }
  void onResume(TickContext& context) override { watch_.resume(context.now_ns); }
  Release onSuspend(TickContext& context) override;

  Input<Duration> msec_;
  Stopwatch watch_;
};

}  // namespace swiftlet::tree
