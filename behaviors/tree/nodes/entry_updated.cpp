#include "behaviors/tree/nodes/entry_updated.hpp"

namespace swiftlet::tree {

PortManifest EntryNews::port() {
  return {.name = "entry",
          .type = PortType::kAny,
          .required = true,
          .description = "The entry whose writes are noticed.",
          .names_entry = true};
}

NodeManifest WasEntryUpdated::manifest() {
  return {.id = "WasEntryUpdated",
          .kind = NodeKind::kCondition,
          .ports = {EntryNews::port()},
          .description = "SUCCESS if an entry was written since the last time."};
}

Status WasEntryUpdated::act(TickContext&) {
  const bool any = news_.any();
  news_.see();
  return any ? Status::kSuccess : Status::kFailure;
}

NodeManifest SkipUnlessUpdated::manifest() {
  return {.id = "SkipUnlessUpdated",
          .kind = NodeKind::kDecorator,
          .ports = {EntryNews::port()},
          .description = "The child if an entry was written since the last time, else it is skipped."};
}

NodeManifest WaitValueUpdate::manifest() {
  return {.id = "WaitValueUpdate",
          .kind = NodeKind::kDecorator,
          .ports = {EntryNews::port()},
          .description = "Waits until an entry is written, then runs the child."};
}

bool UnlessUpdated::onAsked(const TickContext& context) const {
  return news_.any() ? Composite::onAsked(context) : without_ != Status::kSkipped;
}

Status UnlessUpdated::run(TickContext& context) {
  if (!isActive(child().status())) {
    const bool any = news_.any();
    news_.see();
    if (!any) return without_;
  }
  return child().tick(context);
}

}  // namespace swiftlet::tree
