// Script runs a script and is SUCCESS; ScriptCondition is SUCCESS if its script is true, else FAILURE. Both fail with
// the reason if the script cannot be evaluated.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {

class ScriptNode final : public Leaf {
 public:
  explicit ScriptNode(const NodeSetup& setup) : Leaf(setup), code_(setup.port("code").script) {}
  static NodeManifest manifest();

 private:
  Status act(TickContext& context) override;

  Script* code_;
};

class ScriptCondition final : public Leaf {
 public:
  explicit ScriptCondition(const NodeSetup& setup) : Leaf(setup), code_(setup.port("code").script) {}
  static NodeManifest manifest();

 private:
  Status act(TickContext& context) override;

  Script* code_;
};

}  // namespace swiftlet::tree
