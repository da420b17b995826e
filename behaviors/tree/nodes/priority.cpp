#include "behaviors/tree/nodes/priority.hpp"

#include <utility>

namespace swiftlet::tree {

NodeManifest Priority::manifest() {
  return {.id = "Priority",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The highest child that is active controls the vehicle; lower ones are suspended meanwhile."};
}

void Priority::clear(TickContext&) { holder_ = asker_ = kNone; }

Status Priority::run(TickContext& context) {
  bool anything = false;
  for (std::size_t i = 0; i < count(); ++i) {
    if (!child(i).wants(context)) {
      child(i).markSkipped(context);
      continue;
    }
    if (!lowerHaveLetGo(context, i)) return Status::kRunning;
    give(context, i);
    switch (child(i).tick(context)) {
      case Status::kRunning:
        return Status::kRunning;
      case Status::kSuccess:
        anything = true;
        break;
      case Status::kSkipped:
        break;
      case Status::kFailure:
      case Status::kIdle:
      case Status::kSuspended:
        return endWith(context, Status::kFailure);
    }
  }
  return anything ? Status::kSuccess : Status::kSkipped;
}

bool Priority::lowerHaveLetGo(TickContext& context, std::size_t index) {
  if (holder_ == kNone || holder_ <= index || child(holder_).status() != Status::kRunning) return true;
  if (asker_ != index) {
    asker_ = index;
    if (!isActive(child(index).status()))
      child(index).reset(context);  // The child is waiting, and SKIPPED would be wrong.
    report(context, Switch::Kind::kLetsGo, index, child(index).reason(context));
  }
  return child(holder_).suspend(context) == Release::kReleased;
}

void Priority::give(TickContext& context, std::size_t index) {
  if (holder_ != index) {
    const bool from_above = holder_ != kNone && holder_ < index;
    report(context, Switch::Kind::kTakes, index,
           from_above ? child(holder_).name() + " ended with " + toString(child(holder_).status())
                      : child(index).reason(context));
  } else if (asker_ != kNone) {
    report(context, Switch::Kind::kKeeps, index, child(asker_).name() + " no longer asks");
  }
  holder_ = index;
  asker_ = kNone;
}

void Priority::report(TickContext& context, Switch::Kind kind, std::size_t to, std::string reason) const {
  if (context.observer == nullptr) return;
  if (reason.empty())
    reason = holder_ == kNone ? "nothing above it asks for the vehicle" : "it stands above " + child(holder_).name();
  context.observer->onSwitch({.kind = kind,
                              .priority = this,
                              .from = holder_ == kNone ? nullptr : &child(holder_),
                              .to = &child(to),
                              .reason = std::move(reason)});
}

}  // namespace swiftlet::tree
