#include "behaviors/tree/nodes/force_failure.hpp"

namespace swiftlet::tree {

NodeManifest ForceFailure::manifest() {
  return {.id = "ForceFailure",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "FAILURE however the child ends."};
}

Status ForceFailure::run(TickContext& context) {
  switch (const Status status = child().tick(context)) {
    case Status::kSuccess:
    case Status::kFailure:
      return Status::kFailure;
    case Status::kRunning:
    case Status::kSkipped:
    case Status::kIdle:
    case Status::kSuspended:
      return status;
  }
  return Status::kFailure;
}

}  // namespace swiftlet::tree
