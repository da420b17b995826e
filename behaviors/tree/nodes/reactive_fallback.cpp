#include "behaviors/tree/nodes/reactive_fallback.hpp"

namespace swiftlet::tree {

NodeManifest ReactiveFallback::manifest() {
  return {.id = "ReactiveFallback",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "Every child from the first at every tick, until one succeeds; halts what runs then."};
}

}  // namespace swiftlet::tree
