// Fallback: the children one after the other until one succeeds; a child that ended is not asked again.
//   child RUNNING  -> RUNNING, and goes on with this child at the next tick
//   child FAILURE  -> the next child, in the same tick
//   child SKIPPED  -> the next child, in the same tick
//   child SUCCESS  -> SUCCESS
//   after the last: FAILURE, or SKIPPED when all were skipped.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

class Fallback final : public Chain {
 public:
  explicit Fallback(const NodeSetup& setup) : Chain(setup, Status::kFailure) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
