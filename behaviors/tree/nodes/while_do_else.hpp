// WhileDoElse: the first child is the condition, asked at every tick. While it is SUCCESS the second child runs, while
// it is FAILURE the third, if there is one; when the condition changes, the child that runs is halted first.
//   condition RUNNING                  -> RUNNING
//   condition SKIPPED                  -> SKIPPED, what runs is halted
//   condition FAILURE, no third child  -> FAILURE, what runs is halted
//   else                               -> the status of the second or third child; SUCCESS where that is SKIPPED,
//                                         because the condition has been ticked
// While a halted child is released (it may take several ticks) the node is RUNNING and ticks no other child.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class WhileDoElse final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { chosen_ = 0; }
  bool onAsked(const TickContext& context) const override { return child().wants(context); }

  std::size_t chosen_ = 0;  ///< The child that the condition chose last; 0: no child.
};

}  // namespace swiftlet::tree
