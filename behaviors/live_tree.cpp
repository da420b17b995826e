#include "behaviors/live_tree.hpp"

namespace swiftlet::behaviors {

using tree::Status;

LiveTree::LiveTree(const tree::Tree& tree)
    : tree_(tree), told_s_(tree.nodes().size(), -1.0), shown_writes_(tree.nodes().size()) {
  for (const tree::NodeView& node : tree.view()) {
    const tree::NodeRecord& record = tree.nodes()[static_cast<std::size_t>(node.id)];
    view_.push_back({node.id, node.parent, node.name, toString(node.status), std::string(typeNameOf(record))});
    showPorts(node.id);
  }
}

void LiveTree::showPorts(int id) {
  common::TreeNodeView& shown = view_[static_cast<std::size_t>(id)];
  shown.ports.clear();
  for (tree::PortView& port : tree_.portsOf(id))
    shown.ports.push_back({std::move(port.name), std::move(port.entry), std::move(port.value)});
  shown_writes_[static_cast<std::size_t>(id)] = tree_.writesOfPorts(id);
}

const common::TreeView& LiveTree::view() {
  for (std::size_t id = 0; id < view_.size(); ++id)
    if (tree_.writesOfPorts(static_cast<int>(id)) != shown_writes_[id]) showPorts(static_cast<int>(id));
  return view_;
}

void LiveTree::onStatus(const tree::Node& node, Status from, Status to) {
  common::TreeNodeView& shown = of(node);
  shown.status = toString(to);
  // A node that is not under way and gets a result began and ended in this tick.
  const bool ends = to == Status::kSuccess || to == Status::kFailure;
  if (!tree::isActive(from) && (to == Status::kRunning || ends)) {
    shown.began_s = now_s_;
    shown.duration_s.reset();
    // A Priority reports why it starts a child before it does.
    if (to == Status::kRunning && told_s_[static_cast<std::size_t>(node.id())] != now_s_) shown.reason.clear();
  }
  if ((ends || tree::isActive(from)) && !tree::isActive(to) && shown.began_s)
    shown.duration_s = now_s_ - *shown.began_s;
  if (to == Status::kSuccess) shown.reason.clear();
}

void LiveTree::onSwitch(const tree::Switch& change) {
  if (change.to != nullptr) tell(*change.to, change.reason);
}

void LiveTree::onFailure(const tree::Node& node, std::string_view reason) { tell(node, reason); }

void LiveTree::tell(const tree::Node& node, std::string_view reason) {
  of(node).reason = reason;
  told_s_[static_cast<std::size_t>(node.id())] = now_s_;
}

}  // namespace swiftlet::behaviors
