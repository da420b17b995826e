#include "behaviors/tree/node.hpp"

#include <cassert>

namespace swiftlet::tree {

Status Node::tick(TickContext& context) {
  if (letting_go_ == LettingGo::kHalting && halt(context) == Release::kLettingGo) return Status::kRunning;
  if (!isActive(status_)) {
    onStart(context);
  } else if (status_ == Status::kSuspended || letting_go_ == LettingGo::kSuspending) {
    letting_go_ = LettingGo::kNo;
    onResume(context);
  }
  const Status status = onTick(context);
  assert(status != Status::kIdle && status != Status::kSuspended);
  setStatus(context, status);
  return status;
}

Release Node::suspend(TickContext& context) {
  if (status_ != Status::kRunning) return Release::kReleased;
  if (letting_go_ == LettingGo::kHalting) return halt(context);
  letting_go_ = LettingGo::kSuspending;
  if (onSuspend(context) == Release::kLettingGo) return Release::kLettingGo;
  letting_go_ = LettingGo::kNo;
  setStatus(context, Status::kSuspended);
  return Release::kReleased;
}

Release Node::halt(TickContext& context) {
  if (status_ == Status::kRunning) {
    letting_go_ = LettingGo::kHalting;
    if (onHalt(context) == Release::kLettingGo) return Release::kLettingGo;
    letting_go_ = LettingGo::kNo;
  }
  reset(context);
  return Release::kReleased;
}

void Node::reset(TickContext& context) {
  if (status_ == Status::kIdle) return;
  setStatus(context, Status::kIdle);
  for (const auto& child : children()) child->reset(context);
}

Status Node::fail(TickContext& context, std::string_view reason) const {
  if (context.observer != nullptr) context.observer->onFailure(*this, reason);
  return Status::kFailure;
}

std::string Node::reason(const TickContext&) const { return {}; }

const std::vector<std::unique_ptr<Node>>& Node::children() const {
  static const std::vector<std::unique_ptr<Node>> kNone;
  return kNone;
}

void Node::setStatus(TickContext& context, Status status) {
  if (status == status_) return;
  const Status from = status_;
  status_ = status;
  if (context.observer != nullptr) context.observer->onStatus(*this, from, status);
}

}  // namespace swiftlet::tree
