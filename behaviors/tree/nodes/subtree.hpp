// SubTree: runs another tree in this place, with blackboard entries of its own, and has the status of that tree. The
// shared entries are fixed when the tree is built, see builder.hpp.
#pragma once

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class SubTree final : public Composite {
 public:
  using Composite::Composite;

 private:
  Status run(TickContext& context) override { return child().tick(context); }
};

}  // namespace swiftlet::tree
