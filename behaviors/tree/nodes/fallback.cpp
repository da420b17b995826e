#include "behaviors/tree/nodes/fallback.hpp"

namespace swiftlet::tree {

NodeManifest Fallback::manifest() {
  return {.id = "Fallback",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The children one after the other, until one succeeds."};
}

}  // namespace swiftlet::tree
