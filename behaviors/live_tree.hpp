// The tree of a mission as the page shows it: each node with its status, ports, last reason and duration.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "behaviors/tree/tree.hpp"
#include "common/time.hpp"
#include "common/world/tree_view.hpp"

namespace swiftlet::behaviors {

/// Follows a tree as one of its observers. Between two views it works only on nodes that changed.
class LiveTree final : public tree::Observer {
 public:
  explicit LiveTree(const tree::Tree& tree);

  /// Call before each tick of the tree.
  void setNow(common::Time now) { now_s_ = now.seconds(); }
  /// The nodes after the last tick, with the values that their ports have now.
  const common::TreeView& view();

  void onStatus(const tree::Node& node, tree::Status from, tree::Status to) override;
  void onSwitch(const tree::Switch& change) override;
  void onFailure(const tree::Node& node, std::string_view reason) override;

 private:
  common::TreeNodeView& of(const tree::Node& node) { return view_[static_cast<std::size_t>(node.id())]; }
  void tell(const tree::Node& node, std::string_view reason);
  void showPorts(int id);

  const tree::Tree& tree_;
  double now_s_ = 0.0;
  common::TreeView view_;
  std::vector<double> told_s_;               ///< By node: when its reason was reported.
  std::vector<std::uint64_t> shown_writes_;  ///< By node: Tree::writesOfPorts when its ports were shown.
};

}  // namespace swiftlet::behaviors
