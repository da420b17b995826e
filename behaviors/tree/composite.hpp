// A node with children, and what all of those share: letting go of whatever is under way below.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "behaviors/tree/node.hpp"

namespace swiftlet::tree {

class Composite : public Node {
 public:
  using Node::Node;

  void addChild(std::unique_ptr<Node> child) { children_.push_back(std::move(child)); }
  const std::vector<std::unique_ptr<Node>>& children() const final { return children_; }
  std::string reason(const TickContext& context) const override;

 protected:
  /// The node's own rule; called unless it is ending (see endWith).
  virtual Status run(TickContext& context) = 0;
  /// Clears what the node's rule remembers.
  virtual void clear(TickContext&) {}

  std::size_t count() const { return children_.size(); }
  Node& child(std::size_t index = 0) const { return *children_[index]; }

  /// Ends with `result` once everything below has let go: RUNNING until then, whatever the children would say
  /// meanwhile.
  Status endWith(TickContext& context, Status result);
  /// Halts what is under way below, except `kept`; true when all have let go.
  bool haltOthers(TickContext& context, std::size_t kept);

  Release onSuspend(TickContext& context) override;
  Release onHalt(TickContext& context) override;
  /// Any child wants.
  bool onAsked(const TickContext& context) const override;

 private:
  void onStart(TickContext& context) final;
  Status onTick(TickContext& context) final;

  std::vector<std::unique_ptr<Node>> children_;
  std::optional<Status> ending_;
};

}  // namespace swiftlet::tree
