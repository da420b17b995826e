// TryCatch: all children but the last are tried one after the other, as in a Sequence; when one fails, the last one is
// run.
//   all of them SUCCESS or SKIPPED  -> SUCCESS, SKIPPED when all were
//   one FAILURE                     -> the last child runs; however that ends, FAILURE
// With catch_on_halt="true" the last child is ticked once also when the others are halted.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class TryCatch final : public Composite {
 public:
  explicit TryCatch(const NodeSetup& setup) : Composite(setup), catch_on_halt_(setup, "catch_on_halt") {}
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;
  Release onHalt(TickContext& context) override;
  bool onAsked(const TickContext& context) const override;
  std::size_t tried() const { return count() - 1; }

  Input<bool> catch_on_halt_;
  std::size_t current_ = 0;
  std::size_t skipped_ = 0;
  bool caught_ = false;  ///< The last child runs, or has run.
};

}  // namespace swiftlet::tree
