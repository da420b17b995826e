// Parallel: all children in the same tick, in order.
//   a child that ended with SUCCESS or FAILURE is not asked again; RUNNING and SKIPPED ones are, at every tick
//   success_count children SUCCESS                      -> SUCCESS
//   failure_count children FAILURE, or too few are left -> FAILURE
//   all children SKIPPED in this tick                   -> SKIPPED
//   otherwise                                           -> RUNNING
// A negative count is relative to the number of children: -1 is all of them, and SKIPPED then counts as SUCCESS.
// The counts are checked after each child. When they decide, the running children are halted, which may take several
// ticks (RUNNING); then the result is returned.
#pragma once

#include <vector>

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class Parallel final : public Composite {
 public:
  explicit Parallel(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  /// A count that was read from an entry and is more than the children; nothing if there is none.
  std::optional<Message> problemOfCounts() const;
  void clear(TickContext&) override;

  Input<std::int64_t> success_count_;
  Input<std::int64_t> failure_count_;
  std::vector<bool> ended_;
  std::size_t successes_ = 0;
  std::size_t failures_ = 0;
};

}  // namespace swiftlet::tree
