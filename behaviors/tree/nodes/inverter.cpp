#include "behaviors/tree/nodes/inverter.hpp"

namespace swiftlet::tree {

NodeManifest Inverter::manifest() {
  return {.id = "Inverter",
          .kind = NodeKind::kDecorator,
          .ports = {},
          .description = "SUCCESS becomes FAILURE and FAILURE becomes SUCCESS."};
}

Status Inverter::run(TickContext& context) {
  switch (const Status status = child().tick(context)) {
    case Status::kSuccess:
      return Status::kFailure;
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
