// A node without children. It answers SKIPPED exactly if onAsked() is false; onTick() is
// not called then, and must itself never return SKIPPED.
#pragma once

#include "behaviors/tree/node.hpp"

namespace swiftlet::tree {

class Leaf : public Node {
 public:
  using Node::Node;

 protected:
  /// Starts or continues; called only if onAsked() was true.
  virtual Status act(TickContext& context) = 0;

 private:
  Status onTick(TickContext& context) final {
    if (!isActive(status()) && !onAsked(context)) return Status::kSkipped;
    return act(context);
  }
};

}  // namespace swiftlet::tree
