// Inverter: SUCCESS of the child becomes FAILURE and FAILURE becomes SUCCESS; RUNNING and SKIPPED stay.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class Inverter final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
};

}  // namespace swiftlet::tree
