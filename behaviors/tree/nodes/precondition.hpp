// Precondition: runs the child if a script is true, else has the status `else`. The script is asked while the child is
// not under way; a child that runs is not interrupted (that is what _while does).
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {

class Precondition final : public Composite {
 public:
  explicit Precondition(const NodeSetup& setup);
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  bool onAsked(const TickContext& context) const override;

  Script* if_;
  Input<std::string> else_;
};

}  // namespace swiftlet::tree
