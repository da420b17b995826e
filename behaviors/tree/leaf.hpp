// A node without children. It answers SKIPPED exactly when onAsked() says that it has nothing to do; onTick() is then
// not called and must itself never return SKIPPED.
#pragma once

#include "behaviors/tree/node.hpp"

namespace swiftlet::tree {

class Leaf : public Node {
 public:
  using Node::Node;

 protected:
  /// Starts or goes on; only called when there is something to do.
  virtual Status act(TickContext& context) = 0;

 private:
  Status onTick(TickContext& context) final {
    if (!isActive(status()) && !onAsked(context)) return Status::kSkipped;
    return act(context);
  }
};

}  // namespace swiftlet::tree
