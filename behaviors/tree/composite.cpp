#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

void Composite::onStart(TickContext& context) {
  ending_.reset();
  for (const auto& child : children_) child->reset(context);
  clear(context);
}

Status Composite::onTick(TickContext& context) { return ending_ ? endWith(context, *ending_) : run(context); }

Status Composite::endWith(TickContext& context, Status result) {
  if (haltOthers(context, count())) {
    ending_.reset();
    return result;
  }
  ending_ = result;
  return Status::kRunning;
}

bool Composite::haltOthers(TickContext& context, std::size_t kept) {
  Release all = Release::kReleased;
  for (std::size_t i = 0; i < count(); ++i)
    if (i != kept && isActive(child(i).status())) all = both(all, child(i).halt(context));
  return all == Release::kReleased;
}

Release Composite::onSuspend(TickContext& context) {
  if (ending_) return onHalt(context);
  Release all = Release::kReleased;
  for (const auto& child : children_) all = both(all, child->suspend(context));
  return all;
}

Release Composite::onHalt(TickContext& context) {
  return haltOthers(context, count()) ? Release::kReleased : Release::kLettingGo;
}

bool Composite::onAsked(const TickContext& context) const {
  for (const auto& child : children_)
    if (child->wants(context)) return true;
  return false;
}

std::string Composite::whyItWants(const TickContext& context) const {
  for (const auto& child : children_)
    if (child->wants(context)) return child->reason(context);
  return {};
}

}  // namespace swiftlet::tree
