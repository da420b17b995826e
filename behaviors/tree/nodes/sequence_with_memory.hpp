// SequenceWithMemory: as Sequence, but a FAILURE or a halt does not make it forget which children have succeeded: it
// starts again with the child that failed or was halted. It forgets after the last child. As in AsyncSequence, a child
// that starts and ends in a tick ends that tick, unless it is the last one.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class SequenceWithMemory final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;
  bool onAsked(const TickContext& context) const override;

  std::size_t current_ = 0;
  std::size_t skipped_ = 0;  ///< Since it started.
};

}  // namespace swiftlet::tree
