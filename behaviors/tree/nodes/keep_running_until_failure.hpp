// KeepRunningUntilFailure: RUNNING until the child fails; it is started again after each SUCCESS, at the next tick.
//   child SUCCESS, RUNNING -> RUNNING
//   child FAILURE          -> FAILURE
//   child SKIPPED          -> SKIPPED
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/nodes/ended_as.hpp"

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
    return endedAs(child().tick(context), Status::kRunning, Status::kFailure);
  }
};

}  // namespace swiftlet::tree
