// A node with children, and what all such nodes share: releasing the running nodes below.
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

 protected:
  /// The node's own rule; called unless the node is ending (see endWith).
  virtual Status run(TickContext& context) = 0;
  /// Clears the memory of the node's rule.
  virtual void clear(TickContext&) {}

  std::size_t count() const { return children_.size(); }
  Node& child(std::size_t index = 0) const { return *children_[index]; }

  /// Ends with `result` once everything below is released. It is RUNNING until then, and the children are not asked.
  Status endWith(TickContext& context, Status result);
  /// Halts what is running below, except `kept`; true when all are released.
  bool haltOthers(TickContext& context, std::size_t kept);

  Release onSuspend(TickContext& context) override;
  Release onHalt(TickContext& context) override;
  /// At least one child wants the vehicle.
  bool onAsked(const TickContext& context) const override;
  std::string whyItWants(const TickContext& context) const override;

 private:
  void onStart(TickContext& context) final;
  Status onTick(TickContext& context) final;

  std::vector<std::unique_ptr<Node>> children_;
  std::optional<Status> ending_;
};

}  // namespace swiftlet::tree
