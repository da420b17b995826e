// A node without children. It answers SKIPPED exactly if onAsked() says that it does not want the vehicle; onTick() is
// not called then, and must itself never return SKIPPED.
#pragma once

#include "behaviors/tree/node.hpp"

namespace swiftlet::tree {

class Leaf : public Node {
 public:
  using Node::Node;

 protected:
  /// Starts or continues; called only if the leaf wants the vehicle.
  virtual Status act(TickContext& context) = 0;

 private:
  Status onTick(TickContext& context) final {
    if (!isActive(status()) && !onAsked(context)) return Status::kSkipped;
    return act(context);
  }
};

}  // namespace swiftlet::tree
