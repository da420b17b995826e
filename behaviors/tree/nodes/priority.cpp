#include "behaviors/tree/nodes/priority.hpp"

#include <utility>

namespace swiftlet::tree {

NodeManifest Priority::manifest() {
  return {
      .id = "Priority",
      .kind = NodeKind::kControl,
      .ports = {},
      .description = "The highest child that has something to do has the vehicle; lower ones are suspended meanwhile."};
}

void Priority::clear(TickContext&) { holder_ = asker_ = kNobody; }

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
  if (holder_ == kNobody || holder_ <= index || child(holder_).status() != Status::kRunning) return true;
  if (asker_ != index) {
    asker_ = index;
    if (!isActive(child(index).status())) child(index).reset(context);  // It waits; SKIPPED would be wrong.
    tell(context, Switch::Kind::kLetsGo, index, child(index).reason(context));
  }
  return child(holder_).suspend(context) == Release::kReleased;
}

void Priority::give(TickContext& context, std::size_t index) {
  if (holder_ != index) {
    const bool from_above = holder_ != kNobody && holder_ < index;
    tell(context, Switch::Kind::kTakes, index,
         from_above ? child(holder_).name() + " ended with " + toString(child(holder_).status())
                    : child(index).reason(context));
  } else if (asker_ != kNobody) {
    tell(context, Switch::Kind::kKeeps, index, child(asker_).name() + " asks no longer");
  }
  holder_ = index;
  asker_ = kNobody;
}

void Priority::tell(TickContext& context, Switch::Kind kind, std::size_t to, std::string reason) const {
  if (context.observer == nullptr) return;
  if (reason.empty())
    reason = holder_ == kNobody ? "nothing above it asks for the vehicle" : "it stands above " + child(holder_).name();
  context.observer->onSwitch({.kind = kind,
                              .priority = this,
                              .from = holder_ == kNobody ? nullptr : &child(holder_),
                              .to = &child(to),
                              .reason = std::move(reason)});
}

}  // namespace swiftlet::tree
