#include "behaviors/tree/nodes/inverter.hpp"

#include "behaviors/tree/nodes/ended_as.hpp"

namespace swiftlet::tree {

NodeManifest Inverter::manifest() {
  return {.id = "Inverter",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "SUCCESS becomes FAILURE and FAILURE becomes SUCCESS."};
}

Status Inverter::run(TickContext& context) {
  return endedAs(child().tick(context), Status::kFailure, Status::kSuccess);
}

}  // namespace swiftlet::tree
