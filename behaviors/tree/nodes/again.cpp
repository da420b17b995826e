#include "behaviors/tree/nodes/again.hpp"

namespace swiftlet::tree {

bool Again::onAsked(const TickContext& context) const {
  const auto times = times_.get();
  return !times || *times == 0 || Composite::onAsked(context);
}

Status Again::run(TickContext& context) {
  auto times = times_.get();
  if (!times) return endWith(context, fail(context, times_.problem()));

  const auto goesOn = [&] { return *times == -1 || done_ < *times; };
  while (goesOn()) {
    const bool starts_now = !isActive(child().status());
    const Status status = child().tick(context);
    if (status != counted_) return status;
    ++done_;
    // The child may have written it.
    if (counted_ == Status::kFailure)
      if (const auto now = times_.get()) times = now;
    // A round that began and ended in this tick ends the tick, so that no tick is endless.
    if (starts_now && goesOn()) return Status::kRunning;
  }
  return endWith(context, counted_);
}

}  // namespace swiftlet::tree
