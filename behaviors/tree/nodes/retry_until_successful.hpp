// RetryUntilSuccessful: runs the child again after each failure, at most num_attempts times; -1: forever; 0: FAILURE
// without asking it.
//   child FAILURE  -> the next attempt; FAILURE after the last
//   child SUCCESS  -> SUCCESS
//   child RUNNING  -> RUNNING
//   child SKIPPED  -> SKIPPED; the count starts over
// An attempt that started in this tick and ended in it ends the tick (RUNNING), so that no tick is endless.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/again.hpp"

namespace swiftlet::tree {

class RetryUntilSuccessful final : public Again {
 public:
  explicit RetryUntilSuccessful(const NodeSetup& setup) : Again(setup, "num_attempts", Status::kFailure) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
