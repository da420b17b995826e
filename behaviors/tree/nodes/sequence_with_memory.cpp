#include "behaviors/tree/nodes/sequence_with_memory.hpp"

namespace swiftlet::tree {

NodeManifest SequenceWithMemory::manifest() {
  return {
      .id = "SequenceWithMemory",
      .kind = NodeKind::kControl,
      .ports = {},
      .description = "The children one after the other; after a failure or a halt it starts again with that child."};
}

void SequenceWithMemory::clear(TickContext&) { skipped_ = 0; }

bool SequenceWithMemory::onAsked(const TickContext& context) const {
  // What it did before makes it SUCCESS, even if all that is left is skipped.
  if (current_ > 0) return true;
  for (std::size_t i = current_; i < count(); ++i)
    if (child(i).wants(context)) return true;
  return false;
}

Status SequenceWithMemory::run(TickContext& context) {
  while (current_ < count()) {
    const bool starts_now = !isActive(child(current_).status());
    const Status status = child(current_).tick(context);
    if (status != Status::kSuccess && status != Status::kSkipped) return status;
    ++current_;
    if (status == Status::kSkipped)
      ++skipped_;
    else if (starts_now && current_ < count())
      return Status::kRunning;
  }
  const bool all_skipped = skipped_ == count();
  current_ = skipped_ = 0;
  return all_skipped ? Status::kSkipped : Status::kSuccess;
}

}  // namespace swiftlet::tree
