#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

Status Chain::run(TickContext& context) {
  while (current_ < count()) {
    const bool starts_now = !isActive(child(current_).status());
    const Status status = child(current_).tick(context);
    if (status != goes_on_ && status != Status::kSkipped) return status;
    ++current_;
    if (status == Status::kSkipped)
      ++skipped_;
    else if (asynchronous_ && starts_now && current_ < count())
      return Status::kRunning;
  }
  return skipped_ == count() ? Status::kSkipped : goes_on_;
}

}  // namespace swiftlet::tree
