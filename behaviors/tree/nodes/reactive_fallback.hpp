// ReactiveFallback: every child from the first, at every tick; the earliest that can is preferred.
//   child FAILURE  -> the next child, in the same tick; asked anew at the next tick
//   child SKIPPED  -> the next child, in the same tick
//   child RUNNING  -> RUNNING; any other child that is under way is halted
//   child SUCCESS  -> what is under way is halted, then SUCCESS
//   after the last: FAILURE, or SKIPPED when all were skipped in this tick.
// While a halted child lets go (it may take several ticks) the node is RUNNING and ticks nobody; a SUCCESS stands.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

class ReactiveFallback final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { running_ = kNobody; }

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
  std::size_t running_ = kNobody;  ///< The child that answered RUNNING last.
};

}  // namespace swiftlet::tree
