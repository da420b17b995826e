// SetBlackboard: writes `value` to the entry `output_key` (`key` or `{key}`) and is SUCCESS. A value `{other}` is
// copied unchanged; FAILURE if that entry is not set.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class SetBlackboard final : public Leaf {
 public:
  explicit SetBlackboard(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status act(TickContext& context) override;

  PortBinding value_;
  Output output_key_;
};

}  // namespace swiftlet::tree
