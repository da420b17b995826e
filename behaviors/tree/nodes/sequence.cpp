#include "behaviors/tree/nodes/sequence.hpp"

namespace swiftlet::tree {

NodeManifest Sequence::manifest() {
  return {.id = "Sequence",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The children one after the other, until one fails."};
}

Status Sequence::run(TickContext& context) {
  for (; current_ < count(); ++current_) {
    switch (const Status status = child(current_).tick(context)) {
      case Status::kSuccess:
        break;
      case Status::kSkipped:
        ++skipped_;
        break;
      case Status::kRunning:
      case Status::kFailure:
      case Status::kIdle:
      case Status::kSuspended:
        return status;
    }
  }
  return skipped_ == count() ? Status::kSkipped : Status::kSuccess;
}

}  // namespace swiftlet::tree
