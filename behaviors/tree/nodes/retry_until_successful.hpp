// RetryUntilSuccessful: the child again after each failure, num_attempts times in all; -1: for ever; 0: FAILURE without
// asking it.
//   child FAILURE  -> the next attempt; FAILURE after the last
//   child SUCCESS  -> SUCCESS
//   child RUNNING  -> RUNNING
//   child SKIPPED  -> SKIPPED; the count starts anew
// An attempt that started in this tick and ended in it ends the tick (RUNNING), so that no tick is endless.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

class RetryUntilSuccessful final : public Composite {
 public:
  explicit RetryUntilSuccessful(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { done_ = 0; }
  bool onAsked(const TickContext& context) const override;

  Input<std::int64_t> num_attempts_;
  std::int64_t done_ = 0;
};

}  // namespace swiftlet::tree
