// UnsetBlackboard: the entry `key` (`key` or `{key}`) has no value any more; SUCCESS. As in BehaviorTree.CPP an entry
// that the tree shares with an outer one, or that is named by `@`, keeps its value.
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

  Slot* key_;  ///< Null if the entry keeps its value.
};

}  // namespace swiftlet::tree
