#include "behaviors/tree/nodes/repeat.hpp"

namespace swiftlet::tree {

NodeManifest Repeat::manifest() {
  return {.id = "Repeat",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "num_cycles",
                     .type = PortType::kInt,
                     .required = true,
                     .minimum = -1,
                     .description = "Successes of the child after which the node succeeds; -1: for ever."}},
          .description = "The child again and again, until it fails."};
}

}  // namespace swiftlet::tree
