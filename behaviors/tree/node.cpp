#include "behaviors/tree/node.hpp"

#include <cassert>
#include <exception>
#include <string>
#include <utility>

#include "behaviors/tree/conditions.hpp"

namespace swiftlet::tree {
namespace {

/// What is being thrown. Only for a handler.
std::string thrown() {
  try {
    throw;
  } catch (const std::exception& error) {
    return std::string("threw an exception: ") + error.what();
  } catch (...) {
    return "threw what is no exception";
  }
}

}  // namespace

Status Node::tick(TickContext& context) {
  if (letting_go_ == LettingGo::kHalting && halt(context) == Release::kLettingGo) return Status::kRunning;
  if (conditions_ != nullptr)
    if (const auto decided = decidedBefore(context)) return end(context, *decided);
  return end(context, followRule(context));
}

Status Node::followRule(TickContext& context) {
  try {
    if (!isActive(status_)) {
      onStart(context);
    } else if (status_ == Status::kSuspended || letting_go_ == LettingGo::kSuspending) {
      letting_go_ = LettingGo::kNo;
      onResume(context);
    }
    const Status status = onTick(context);
    assert(status != Status::kIdle && status != Status::kSuspended);
    return status;
  } catch (...) {
    return fail(context, thrown());
  }
}

/// A node that throws while it is released counts as released.
Release Node::releasedBy(Release (Node::*ask)(TickContext&), TickContext& context) {
  try {
    return (this->*ask)(context);
  } catch (...) {
    (void)fail(context, thrown());
    return Release::kReleased;
  }
}

bool Node::asksForVehicle(const TickContext& context) const {
  try {
    return onAsked(context);
  } catch (...) {
    return true;  // Its tick says why it fails.
  }
}

std::string Node::reason(const TickContext& context) const {
  try {
    return whyItWants(context);
  } catch (...) {
    return thrown();
  }
}

/// The status that the conditions decide without the node's own rule, if they do.
std::optional<Status> Node::decidedBefore(TickContext& context) {
  Conditions& conditions = *conditions_;
  if (conditions.leaving) return std::exchange(conditions.leaving, std::nullopt);
  if (!isActive(status_)) {
    const StartDecision decision = conditions.atStart();
    return decision.failed ? fail(context, conditions.problem()) : decision.status;
  }
  const auto goes_on = conditions.goesOn();
  if (goes_on && *goes_on) return std::nullopt;
  const Status ending = goes_on ? Status::kSkipped : fail(context, conditions.problem());
  if (halt(context) == Release::kReleased) return ending;
  conditions.leaving = ending;
  return Status::kRunning;
}

Status Node::end(TickContext& context, Status status) {
  if (conditions_ != nullptr && !conditions_->afterwards(status)) status = fail(context, conditions_->problem());
  setStatus(context, status);
  return status;
}

bool Node::wants(const TickContext& context) const {
  if (isActive(status_)) return true;
  const auto decided = conditions_ == nullptr ? StartDecision{} : conditions_->atStart();
  return decided.status ? *decided.status != Status::kSkipped : asksForVehicle(context);
}

Release Node::suspend(TickContext& context) {
  if (status_ != Status::kRunning) return Release::kReleased;
  if (letting_go_ == LettingGo::kHalting) return halt(context);
  letting_go_ = LettingGo::kSuspending;
  if (releasedBy(&Node::onSuspend, context) == Release::kLettingGo) return Release::kLettingGo;
  letting_go_ = LettingGo::kNo;
  setStatus(context, Status::kSuspended);
  return Release::kReleased;
}

Release Node::halt(TickContext& context) {
  if (status_ == Status::kRunning) {
    letting_go_ = LettingGo::kHalting;
    if (releasedBy(&Node::onHalt, context) == Release::kLettingGo) return Release::kLettingGo;
    letting_go_ = LettingGo::kNo;
  }
  if (conditions_ != nullptr && isActive(status_)) {
    conditions_->leaving.reset();
    if (!conditions_->afterHalt()) (void)fail(context, conditions_->problem());
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
