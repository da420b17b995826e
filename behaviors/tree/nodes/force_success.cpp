#include "behaviors/tree/nodes/force_success.hpp"

#include "behaviors/tree/nodes/ended_as.hpp"

namespace swiftlet::tree {

NodeManifest ForceSuccess::manifest() {
  return {.id = "ForceSuccess",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "SUCCESS however the child ends."};
}

Status ForceSuccess::run(TickContext& context) {
  return endedAs(child().tick(context), Status::kSuccess, Status::kSuccess);
}

}  // namespace swiftlet::tree
