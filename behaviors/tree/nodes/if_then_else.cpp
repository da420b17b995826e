#include "behaviors/tree/nodes/if_then_else.hpp"

#include "behaviors/tree/nodes/ended_as.hpp"

namespace swiftlet::tree {

NodeManifest IfThenElse::manifest() {
  return {.id = "IfThenElse",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The second child if the first succeeds, else the third, if there is one.",
          .least_children = 2,
          .most_children = 3};
}

Status IfThenElse::run(TickContext& context) {
  if (chosen_ == 0) {
    const Status condition = child().tick(context);
    if (condition == Status::kRunning || condition == Status::kSkipped) return condition;
    if (condition == Status::kFailure && count() == 2) return Status::kFailure;
    chosen_ = condition == Status::kSuccess ? 1 : 2;
  }
  return skippedAsSuccess(child(chosen_).tick(context));
}

}  // namespace swiftlet::tree
