// KeepRunningUntilFailure: RUNNING until the child fails; it is started again after each SUCCESS, at the next tick.
//   child SUCCESS, RUNNING, SKIPPED -> RUNNING
//   child FAILURE                   -> FAILURE
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class KeepRunningUntilFailure final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest() {
    return {.id = "KeepRunningUntilFailure",
            .kind = NodeKind::kDecorator,
            .ports = {},
            .description = "The child again and again, until it fails."};
  }

 private:
  Status run(TickContext& context) override {
    return child().tick(context) == Status::kFailure ? Status::kFailure : Status::kRunning;
  }
  bool onAsked(const TickContext&) const override { return true; }
};

}  // namespace swiftlet::tree
