// AsyncSequence: as Sequence, but a child that starts and ends in a tick ends that tick, unless it is the last one, so
// that nodes above may act in between.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

class AsyncSequence final : public Chain {
 public:
  explicit AsyncSequence(const NodeSetup& setup) : Chain(setup, Status::kSuccess, true) {}
  static NodeManifest manifest() {
    return {.id = "AsyncSequence",
            .kind = NodeKind::kControl,
            .ports = {},
            .description = "The children one after the other, until one fails; no two start in one tick."};
  }
};

}  // namespace swiftlet::tree
