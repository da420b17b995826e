// ReactiveSequence: every child from the first, at every tick; for conditions that must keep holding.
//   child SUCCESS  -> the next child, in the same tick; asked again at the next tick
//   child SKIPPED  -> the next child, in the same tick
//   child RUNNING  -> RUNNING; any other child that is under way is halted
//   child FAILURE  -> what is under way is halted, then FAILURE
//   after the last: SUCCESS, or SKIPPED when all were skipped in this tick.
// Until a halted child is released (it may take some ticks) the node is RUNNING and ticks no child; a FAILURE is kept.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/reactive.hpp"

namespace swiftlet::tree {

class ReactiveSequence final : public Reactive {
 public:
  explicit ReactiveSequence(const NodeSetup& setup) : Reactive(setup, Status::kSuccess, Status::kFailure) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
