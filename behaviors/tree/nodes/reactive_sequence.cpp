#include "behaviors/tree/nodes/reactive_sequence.hpp"

namespace swiftlet::tree {

NodeManifest ReactiveSequence::manifest() {
  return {.id = "ReactiveSequence",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "Every child from the first at every tick, until one fails; halts what runs then."};
}

}  // namespace swiftlet::tree
