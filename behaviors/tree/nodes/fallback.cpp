#include "behaviors/tree/nodes/fallback.hpp"

namespace swiftlet::tree {

NodeManifest Fallback::manifest() {
  return {.id = "Fallback",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The children one after the other, until one succeeds."};
}

Status Fallback::run(TickContext& context) {
  for (; current_ < count(); ++current_) {
    switch (const Status status = child(current_).tick(context)) {
      case Status::kFailure:
        break;
      case Status::kSkipped:
        ++skipped_;
        break;
      case Status::kRunning:
      case Status::kSuccess:
      case Status::kIdle:
      case Status::kSuspended:
        return status;
    }
  }
  return skipped_ == count() ? Status::kSkipped : Status::kFailure;
}

}  // namespace swiftlet::tree
