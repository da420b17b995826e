#include "behaviors/narrator.hpp"

#include <utility>

#include "behaviors/tree/nodes/priority.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::Node;
using tree::Status;
using tree::Switch;

/// The node that acts in a child of a Priority: the running leaf in it, or the one that a tick would reach first now;
/// the child itself if it has ended.
const Node& actingIn(const Node& node, const tree::TickContext& tick) {
  for (const auto& child : node.children())
    if (tree::isActive(child->status())) return actingIn(*child, tick);
  if (node.status() != Status::kSuccess && node.status() != Status::kFailure)
    for (const auto& child : node.children())
      if (child->wants(tick)) return actingIn(*child, tick);
  return node;
}

}  // namespace

void Narrator::onStatus(const Node& node, Status from, Status to) {
  if (to == Status::kSuccess) forgiveBelow(node);
  if (!node.children().empty() && to != Status::kFailure) return;
  switch (to) {
    case Status::kRunning:
      if (!tree::isActive(from) && !isReportedBySwitches(node))
        say(common::Severity::kInfo, node.name() + " starts", {});
      break;
    case Status::kSuccess:
      if (tree::isActive(from) && !isReportedBySwitches(node))
        say(common::Severity::kInfo, node.name() + " is done", {});
      break;
    case Status::kFailure:
      if (failed_node_ != node.id()) break;  // A parent that fails because its child did adds no information.
      if (!isCondition(node)) say(common::Severity::kWarning, node.name() + " failed", failure_reason_);
      failed_node_ = -1;
      break;
    case Status::kIdle:
      if (from == Status::kRunning) say(common::Severity::kInfo, node.name() + " is cancelled", {});
      break;
    case Status::kSkipped:
    case Status::kSuspended:
      break;
  }
}

void Narrator::onSwitch(const Switch& change) {
  if (tick_ == nullptr) return;
  const std::string& to = actingIn(*change.to, *tick_).name();
  switch (change.kind) {
    case Switch::Kind::kLetsGo:
      say(common::Severity::kInfo, actingIn(*change.from, *tick_).name() + " yields to " + to, change.reason);
      return;
    case Switch::Kind::kKeeps:
      say(common::Severity::kInfo, to + " continues", change.reason);
      return;
    case Switch::Kind::kTakes:
      break;
  }
  if (change.to->status() == Status::kSuspended)
    say(common::Severity::kInfo, to + " resumes", change.reason);
  else if (change.from == nullptr)
    say(common::Severity::kInfo, to + " takes control", change.reason);
  else
    say(common::Severity::kInfo, to + " takes over from " + actingIn(*change.from, *tick_).name(), change.reason);
}

void Narrator::onFailure(const Node& node, std::string_view reason) {
  failed_node_ = node.id();
  failure_reason_ = reason;
  std::erase_if(failures_, [&](const Failure& failure) { return failure.node == node.id(); });
  failures_.push_back({node.id(), node.name() + ": " + failure_reason_ + " [" + tree_.pathOf(node.id()) + "]"});
}

std::string Narrator::failure() const {
  if (failures_.empty()) return {};
  const std::string& first = failures_.front().text;
  return failures_.size() == 1 ? first : first + ", and then " + failures_.back().text;
}

/// A failure below a node that succeeds in the end is no longer a cause.
void Narrator::forgiveBelow(const Node& node) {
  const auto isBelow = [&](int id) {
    while (id > node.id()) id = tree_.nodes()[static_cast<std::size_t>(id)].parent;
    return id == node.id();
  };
  std::erase_if(failures_, [&](const Failure& failure) { return isBelow(failure.node); });
}

/// A condition that is false is no failure: it is asked again at each tick.
bool Narrator::isCondition(const Node& node) const {
  const tree::NodeManifest* manifest = tree_.nodes()[static_cast<std::size_t>(node.id())].manifest;
  return manifest != nullptr && manifest->kind == tree::NodeKind::kCondition;
}

/// A child of a Priority: its event already names the active child.
bool Narrator::isReportedBySwitches(const Node& node) const {
  const int parent = tree_.nodes()[static_cast<std::size_t>(node.id())].parent;
  if (parent < 0) return false;
  return dynamic_cast<const tree::Priority*>(tree_.nodes()[static_cast<std::size_t>(parent)].node) != nullptr;
}

void Narrator::say(common::Severity severity, std::string text, std::string reason) {
  if (tick_ != nullptr) tick_->say(severity, std::move(text), std::move(reason));
}

}  // namespace swiftlet::behaviors
