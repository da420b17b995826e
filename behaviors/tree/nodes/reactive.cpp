#include "behaviors/tree/nodes/reactive.hpp"

namespace swiftlet::tree {

Status Reactive::run(TickContext& context) {
  if (running_ != kNone && !haltOthers(context, running_)) return Status::kRunning;
  bool all_skipped = true;
  for (std::size_t i = 0; i < count(); ++i) {
    const Status status = child(i).tick(context);
    all_skipped = all_skipped && status == Status::kSkipped;
    if (status == goes_on_ || status == Status::kSkipped) continue;
    if (status != Status::kRunning) return endWith(context, stops_);
    running_ = i;
    haltOthers(context, i);
    return Status::kRunning;
  }
  return all_skipped ? Status::kSkipped : goes_on_;
}

}  // namespace swiftlet::tree
