#include "behaviors/tree/nodes/sleep.hpp"

namespace swiftlet::tree {

NodeManifest Sleep::manifest() {
  return {.id = "Sleep",
          .kind = NodeKind::kAction,
          .ports = {{.name = "msec",
                     .type = PortType::kDuration,
                     .required = true,
                     .minimum = 0,
                     .description = "Time to wait."}},
          .description = "Waits; the time it is suspended does not count.",
          .may_fail = false};
}

Release Sleep::onSuspend(TickContext& context) {
  watch_.stop(context.now_ns);
  return Release::kReleased;
}

Status Sleep::act(TickContext& context) {
  const auto time = msec_.get();
  if (!time) return fail(context, msec_.problem());
  return watch_.elapsed_ns(context.now_ns) < time->nanoseconds ? Status::kRunning : Status::kSuccess;
}

}  // namespace swiftlet::tree
