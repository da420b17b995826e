#include "behaviors/tree/nodes/force_failure.hpp"

#include "behaviors/tree/nodes/ended_as.hpp"

namespace swiftlet::tree {

NodeManifest ForceFailure::manifest() {
  return {.id = "ForceFailure",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "FAILURE however the child ends."};
}

Status ForceFailure::run(TickContext& context) {
  return endedAs(child().tick(context), Status::kFailure, Status::kFailure);
}

}  // namespace swiftlet::tree
