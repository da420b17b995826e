#include "behaviors/tree/nodes/repeat.hpp"

namespace swiftlet::tree {

NodeManifest Repeat::manifest() {
  return {.id = "Repeat",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "num_cycles",
                     .type = PortType::kInt,
                     .required = true,
                     .minimum = -1,
                     .description = "So many successes of the child; -1: for ever."}},
          .description = "The child again and again, until it fails."};
}

Repeat::Repeat(const NodeSetup& setup) : Composite(setup), num_cycles_(setup, "num_cycles") {}

bool Repeat::onAsked(const TickContext& context) const {
  const auto cycles = num_cycles_.get();
  return !cycles || *cycles == 0 || Composite::onAsked(context);
}

Status Repeat::run(TickContext& context) {
  const auto cycles = num_cycles_.get();
  if (!cycles) return endWith(context, fail(context, num_cycles_.problem()));

  while (*cycles == -1 || done_ < *cycles) {
    const bool starts_now = !isActive(child().status());
    switch (const Status status = child().tick(context)) {
      case Status::kSuccess:
        ++done_;
        if (starts_now && (*cycles == -1 || done_ < *cycles)) return Status::kRunning;
        break;
      case Status::kRunning:
      case Status::kFailure:
      case Status::kSkipped:
      case Status::kIdle:
      case Status::kSuspended:
        return status;
    }
  }
  return endWith(context, Status::kSuccess);
}

}  // namespace swiftlet::tree
