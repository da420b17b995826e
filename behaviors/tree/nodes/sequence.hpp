// Sequence: the children one after the other; a child that ended is not asked again.
//   child RUNNING  -> RUNNING, and goes on with this child at the next tick
//   child SUCCESS  -> the next child, in the same tick
//   child SKIPPED  -> the next child, in the same tick
//   child FAILURE  -> FAILURE
//   after the last: SUCCESS, or SKIPPED when all were skipped.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

class Sequence final : public Chain {
 public:
  explicit Sequence(const NodeSetup& setup) : Chain(setup, Status::kSuccess) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
