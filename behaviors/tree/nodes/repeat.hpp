// Repeat: runs the child num_cycles times; -1: forever; 0: SUCCESS without asking it.
//   child SUCCESS  -> the next cycle; SUCCESS after the last
//   child FAILURE  -> FAILURE
//   child RUNNING  -> RUNNING
//   child SKIPPED  -> SKIPPED; the count starts over
// A cycle that started in this tick and ended in it ends the tick (RUNNING), so that no tick is endless.
#pragma once

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/again.hpp"

namespace swiftlet::tree {

class Repeat final : public Again {
 public:
  explicit Repeat(const NodeSetup& setup) : Again(setup, "num_cycles", Status::kSuccess) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
