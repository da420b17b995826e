#include "behaviors/tree/nodes/force_success.hpp"

namespace swiftlet::tree {

NodeManifest ForceSuccess::manifest() {
  return {.id = "ForceSuccess",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "SUCCESS however the child ends."};
}

Status ForceSuccess::run(TickContext& context) {
  switch (const Status status = child().tick(context)) {
    case Status::kSuccess:
    case Status::kFailure:
      return Status::kSuccess;
    case Status::kRunning:
    case Status::kSkipped:
    case Status::kIdle:
    case Status::kSuspended:
      return status;
  }
  return Status::kFailure;
}

}  // namespace swiftlet::tree
