#include "behaviors/tree/nodes/retry_until_successful.hpp"

namespace swiftlet::tree {

NodeManifest RetryUntilSuccessful::manifest() {
  return {.id = "RetryUntilSuccessful",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "num_attempts",
                     .type = PortType::kInt,
                     .required = true,
                     .minimum = -1,
                     .description = "Attempts in all; -1: for ever."}},
          .description = "The child again after each failure, until it succeeds."};
}

}  // namespace swiftlet::tree
