// IfThenElse: the first child is the condition; the second runs after its SUCCESS, the third, if there is one, after
// its FAILURE. The condition is asked once.
//   condition RUNNING                  -> RUNNING
//   condition SKIPPED                  -> SKIPPED
//   condition FAILURE, no third child  -> FAILURE
//   else                               -> the status of the second or third child; SUCCESS where that is SKIPPED,
//                                         because the condition has been ticked
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class IfThenElse final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override { chosen_ = 0; }
  bool onAsked(const TickContext& context) const override { return child().wants(context); }

  std::size_t chosen_ = 0;  ///< The child that runs: 0 is the condition.
};

}  // namespace swiftlet::tree
