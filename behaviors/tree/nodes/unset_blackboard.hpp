// UnsetBlackboard: the entry `key` (`key` or `{key}`) has no value any more; SUCCESS.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class UnsetBlackboard final : public Leaf {
 public:
  explicit UnsetBlackboard(const NodeSetup& setup) : Leaf(setup), key_(setup.port("key").slot) {}
  static NodeManifest manifest();

 private:
  Status act(TickContext&) override;

  Slot* key_;
};

}  // namespace swiftlet::tree
