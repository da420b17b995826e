// Fallback: the children one after the other until one succeeds; a child that ended is not asked again.
//   child RUNNING  -> RUNNING, and goes on with this child at the next tick
//   child FAILURE  -> the next child, in the same tick
//   child SKIPPED  -> the next child, in the same tick
//   child SUCCESS  -> SUCCESS
//   after the last: FAILURE, or SKIPPED when all were skipped.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

class Fallback final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { current_ = skipped_ = 0; }

  std::size_t current_ = 0;
  std::size_t skipped_ = 0;
};

}  // namespace swiftlet::tree
