#include "behaviors/tree/nodes/reactive_sequence.hpp"

namespace swiftlet::tree {

NodeManifest ReactiveSequence::manifest() {
  return {.id = "ReactiveSequence",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "Every child from the first at every tick, until one fails; halts what runs then."};
}

Status ReactiveSequence::run(TickContext& context) {
  if (running_ != kNobody && !haltOthers(context, running_)) return Status::kRunning;
  bool all_skipped = true;
  for (std::size_t i = 0; i < count(); ++i) {
    const Status status = child(i).tick(context);
    all_skipped = all_skipped && status == Status::kSkipped;
    switch (status) {
      case Status::kSuccess:
      case Status::kSkipped:
        break;
      case Status::kRunning:
        running_ = i;
        haltOthers(context, i);
        return Status::kRunning;
      case Status::kFailure:
      case Status::kIdle:
      case Status::kSuspended:
        return endWith(context, Status::kFailure);
    }
  }
  return all_skipped ? Status::kSkipped : Status::kSuccess;
}

}  // namespace swiftlet::tree
