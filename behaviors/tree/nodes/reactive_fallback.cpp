#include "behaviors/tree/nodes/reactive_fallback.hpp"

namespace swiftlet::tree {

NodeManifest ReactiveFallback::manifest() {
  return {.id = "ReactiveFallback",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "Every child from the first at every tick, until one succeeds; halts what runs then."};
}

Status ReactiveFallback::run(TickContext& context) {
  if (running_ != kNobody && !haltOthers(context, running_)) return Status::kRunning;
  bool all_skipped = true;
  for (std::size_t i = 0; i < count(); ++i) {
    const Status status = child(i).tick(context);
    all_skipped = all_skipped && status == Status::kSkipped;
    switch (status) {
      case Status::kFailure:
      case Status::kSkipped:
        break;
      case Status::kRunning:
        running_ = i;
        haltOthers(context, i);
        return Status::kRunning;
      case Status::kSuccess:
      case Status::kIdle:
      case Status::kSuspended:
        return endWith(context, Status::kSuccess);
    }
  }
  return all_skipped ? Status::kSkipped : Status::kFailure;
}

}  // namespace swiftlet::tree
