// ParallelAll: all children in the same tick, until each of them has ended.
//   a child that ended is not asked again; RUNNING and SKIPPED ones are, at every tick
//   all children SKIPPED in this tick         -> SKIPPED
//   some child RUNNING                        -> RUNNING
//   each ended or SKIPPED, max_failures failed -> FAILURE; fewer: SUCCESS
// A negative max_failures is relative to the number of children: -1 is all of them.
#pragma once

#include <vector>

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class ParallelAll final : public Composite {
 public:
  explicit ParallelAll(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;

  Input<std::int64_t> max_failures_;
  std::vector<bool> ended_;
  std::size_t failures_ = 0;
};

}  // namespace swiftlet::tree
