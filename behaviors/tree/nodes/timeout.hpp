// Timeout: runs the child for at most msec; 0: no limit.
//   child ends or is SKIPPED in time -> the same
//   child RUNNING, time left         -> RUNNING
//   no time left at a tick           -> the child is halted without another tick (RUNNING until it is released),
//                                       then FAILURE
// The clock starts at the first tick and stands still from the tick that suspends this node to the one that resumes it.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/stopwatch.hpp"

namespace swiftlet::tree {

class Timeout final : public Composite {
 public:
  explicit Timeout(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext& context) override { watch_.restart(context.now_ns); }
  void onResume(TickContext& context) override { watch_.resume(context.now_ns); }
  Release onSuspend(TickContext& context) override;

  Input<Duration> msec_;
  Stopwatch watch_;
};

}  // namespace swiftlet::tree
