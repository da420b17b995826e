#include "behaviors/tree/nodes/sequence_with_memory.hpp"

namespace swiftlet::tree {

NodeManifest SequenceWithMemory::manifest() {
  return {
      .id = "SequenceWithMemory",
      .kind = NodeKind::kControl,
      .ports = {},
      .description = "The children one after the other; after a failure or a halt it starts again with that child."};
}

bool SequenceWithMemory::onAsked(const TickContext& context) const {
  // What succeeded before makes it SUCCESS, even if all that is left is skipped.
  if (skipped_ < current_) return true;
  for (std::size_t i = current_; i < count(); ++i)
    if (child(i).wants(context)) return true;
  return false;
}

Status SequenceWithMemory::run(TickContext& context) {
  for (; current_ < count(); ++current_) {
    const Status status = child(current_).tick(context);
    if (status == Status::kSkipped)
      ++skipped_;
    else if (status != Status::kSuccess)
      return status;
  }
  const bool all_skipped = skipped_ == count();
  current_ = skipped_ = 0;
  return all_skipped ? Status::kSkipped : Status::kSuccess;
}

}  // namespace swiftlet::tree
