// AsyncFallback: as Fallback, but a child that starts and ends in a tick ends that tick, unless it is the last one, so
// that nodes above may act in between.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

class AsyncFallback final : public Chain {
 public:
  explicit AsyncFallback(const NodeSetup& setup) : Chain(setup, Status::kFailure, true) {}
  static NodeManifest manifest() {
    return {.id = "AsyncFallback",
            .kind = NodeKind::kControl,
            .ports = {},
            .description = "The children one after the other, until one succeeds; no two start in one tick."};
  }
};

}  // namespace swiftlet::tree
