#include "behaviors/narrator.hpp"

#include <utility>

namespace swiftlet::behaviors {
namespace {

using tree::Node;
using tree::Status;
using tree::Switch;

}  // namespace

void Narrator::onStatus(const Node& node, Status from, Status to) {
  if (to == Status::kSuccess) forgiveBelow(node);
  if (!node.children().empty() && to != Status::kFailure) return;
  switch (to) {
    case Status::kRunning:
      if (!tree::isActive(from) && !isToldBySwitches(node)) say(common::Severity::kInfo, node.name() + " starts", {});
      break;
    case Status::kSuccess:
      if (tree::isActive(from) && !isToldBySwitches(node)) say(common::Severity::kInfo, node.name() + " is done", {});
      break;
    case Status::kFailure:
      if (failed_node_ != node.id()) break;  // A parent that fails because its child did adds nothing.
      say(common::Severity::kWarning, node.name() + " failed", failure_reason_);
      failed_node_ = -1;
      break;
    case Status::kIdle:
      if (from == Status::kRunning) say(common::Severity::kInfo, node.name() + " is given up", {});
      break;
    case Status::kSkipped:
    case Status::kSuspended:
      break;
  }
}

void Narrator::onSwitch(const Switch& change) {
  const std::string& to = change.to_leaf->name();
  switch (change.kind) {
    case Switch::Kind::kLetsGo:
      say(common::Severity::kInfo, change.from_leaf->name() + " lets go for " + to, change.reason);
      return;
    case Switch::Kind::kKeeps:
      say(common::Severity::kInfo, to + " goes on", change.reason);
      return;
    case Switch::Kind::kTakes:
      break;
  }
  if (change.to->status() == Status::kSuspended)
    say(common::Severity::kInfo, to + " resumes", change.reason);
  else if (change.from == nullptr)
    say(common::Severity::kInfo, to + " has the vehicle", change.reason);
  else
    say(common::Severity::kInfo, to + " takes over from " + change.from_leaf->name(), change.reason);
}

void Narrator::onFailure(const Node& node, std::string_view reason) {
  failed_node_ = node.id();
  failure_reason_ = reason;
  std::erase_if(failures_, [&](const Failure& failure) { return failure.node == node.id(); });
  failures_.push_back({node.id(), node.name() + ": " + failure_reason_});
}

std::string Narrator::failure() const {
  if (failures_.empty()) return {};
  const std::string& first = failures_.front().text;
  return failures_.size() == 1 ? first : first + ", and then " + failures_.back().text;
}

/// What failed below a node that succeeds in the end is no cause of anything any more.
void Narrator::forgiveBelow(const Node& node) {
  const auto isBelow = [&](int id) {
    while (id > node.id()) id = tree_.nodes()[static_cast<std::size_t>(id)].parent;
    return id == node.id();
  };
  std::erase_if(failures_, [&](const Failure& failure) { return isBelow(failure.node); });
}

/// A child of a Priority: who has the vehicle is said already.
bool Narrator::isToldBySwitches(const Node& node) const {
  const int parent = tree_.nodes()[static_cast<std::size_t>(node.id())].parent;
  if (parent < 0) return false;
  const tree::NodeManifest* manifest = tree_.nodes()[static_cast<std::size_t>(parent)].manifest;
  return manifest != nullptr && manifest->id == "Priority";
}

void Narrator::say(common::Severity severity, std::string text, std::string reason) {
  if (context_ == nullptr) return;
  context_->events.push_back({context_->now, severity, "mission", std::move(text), std::move(reason)});
}

}  // namespace swiftlet::behaviors
