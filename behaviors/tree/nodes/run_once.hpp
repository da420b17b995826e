// RunOnce: runs the child until it has ended once. After that it is not asked again as long as the tree exists:
// SKIPPED, or with then_skip="false" the status that it ended with.
#pragma once

#include <optional>

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class RunOnce final : public Composite {
 public:
  explicit RunOnce(const NodeSetup& setup) : Composite(setup), then_skip_(setup, "then_skip") {}
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  bool onAsked(const TickContext& context) const override;

  Input<bool> then_skip_;
  std::optional<Status> ended_;
};

}  // namespace swiftlet::tree
