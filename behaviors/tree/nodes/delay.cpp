#include "behaviors/tree/nodes/delay.hpp"

namespace swiftlet::tree {

NodeManifest Delay::manifest() {
  return {.id = "Delay",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "delay_msec",
                     .type = PortType::kDuration,
                     .required = true,
                     .minimum = 0,
                     .description = "Time after which the child starts."}},
          .description = "Starts the child later; the time it is suspended does not count."};
}

Delay::Delay(const NodeSetup& setup) : Composite(setup), delay_msec_(setup, "delay_msec") {}

Release Delay::onSuspend(TickContext& context) {
  watch_.stop(context.now_ns);
  return Composite::onSuspend(context);
}

bool Delay::onAsked(const TickContext& context) const {
  const auto delay = delay_msec_.get();
  return !delay || delay->nanoseconds > 0 || Composite::onAsked(context);
}

Status Delay::run(TickContext& context) {
  const auto delay = delay_msec_.get();
  if (!delay) return endWith(context, fail(context, delay_msec_.problem()));
  if (!isActive(child().status()) && watch_.elapsed_ns(context.now_ns) < delay->nanoseconds) return Status::kRunning;
  return child().tick(context);
}

}  // namespace swiftlet::tree
