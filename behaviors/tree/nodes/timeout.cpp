#include "behaviors/tree/nodes/timeout.hpp"

namespace swiftlet::tree {

NodeManifest Timeout::manifest() {
  return {.id = "Timeout",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "msec",
                     .type = PortType::kDuration,
                     .required = true,
                     .minimum = 0,
                     .description = "Longest time that the child may take; 0: no limit."}},
          .description = "Fails when the child takes too long; the time it is suspended does not count."};
}

Timeout::Timeout(const NodeSetup& setup) : Composite(setup), msec_(setup, "msec") {}

Release Timeout::onSuspend(TickContext& context) {
  watch_.stop(context.now_ns);
  return Composite::onSuspend(context);
}

Status Timeout::run(TickContext& context) {
  const auto limit = msec_.get();
  if (!limit) return endWith(context, fail(context, msec_.problem()));
  if (limit->nanoseconds > 0 && watch_.elapsed_ns(context.now_ns) >= limit->nanoseconds)
    return endWith(context, fail(context, "timed out after " + toString(Value(*limit))));
  return child().tick(context);
}

}  // namespace swiftlet::tree
