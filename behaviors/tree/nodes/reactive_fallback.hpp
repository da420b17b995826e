// ReactiveFallback: every child from the first, at every tick; the earliest that does not fail is preferred.
//   child FAILURE  -> the next child, in the same tick; asked again at the next tick
//   child SKIPPED  -> the next child, in the same tick
//   child RUNNING  -> RUNNING; any other child that is under way is halted
//   child SUCCESS  -> what is under way is halted, then SUCCESS
//   after the last: FAILURE, or SKIPPED when all were skipped in this tick.
// Until a halted child is released (it may take some ticks) the node is RUNNING and ticks no child; a SUCCESS is kept.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/reactive.hpp"

namespace swiftlet::tree {

class ReactiveFallback final : public Reactive {
 public:
  explicit ReactiveFallback(const NodeSetup& setup) : Reactive(setup, Status::kFailure, Status::kSuccess) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
