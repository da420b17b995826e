#include "behaviors/tree/nodes/sequence.hpp"

namespace swiftlet::tree {

NodeManifest Sequence::manifest() {
  return {.id = "Sequence",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The children one after the other, until one fails."};
}

}  // namespace swiftlet::tree
