// Repeat: the child again and again, num_cycles times; -1: for ever; 0: SUCCESS without asking it.
//   child SUCCESS  -> the next cycle; SUCCESS after the last
//   child FAILURE  -> FAILURE
//   child RUNNING  -> RUNNING
//   child SKIPPED  -> SKIPPED; the count starts anew
// A cycle that started in this tick and ended in it ends the tick (RUNNING), so that no tick is endless.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

class Repeat final : public Composite {
 public:
  explicit Repeat(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { done_ = 0; }
  bool onAsked(const TickContext& context) const override;

  Input<std::int64_t> num_cycles_;
  std::int64_t done_ = 0;
};

}  // namespace swiftlet::tree
