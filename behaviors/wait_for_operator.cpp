#include "behaviors/wait_for_operator.hpp"

#include <utility>

#include <fmt/format.h>

#include "behaviors/leaf_traits.hpp"

namespace swiftlet::behaviors {

using tree::PortType;

tree::NodeManifest WaitForOperator::manifest() {
  return {
      .id = "WaitForOperator",
      .kind = tree::NodeKind::kAction,
      .ports = {{.name = "question",
                 .type = PortType::kString,
                 .default_value = "Go on?",
                 .description = "What the page asks the operator."},
                {.name = "timeout_s",
                 .type = PortType::kDuration,
                 .default_value = "0",
                 .minimum = 0.0,
                 .maximum = 86400.0,
                 .description = "Time after which the node fails; 0: it waits without a limit."}},
      .description = "Waits until the operator says go on.",
      .details =
          "On the page, or by `POST /api/go_on`; the vehicle holds meanwhile, and the time of a hold does not count.",
      .ends = "SUCCESS when the operator says so; FAILURE after `timeout_s`, if that is not 0",
      .traits = LeafTraits{.asks_operator = true}};
}

std::string WaitForOperator::question() const {
  return status() == tree::Status::kRunning ? question_.get().value_or("Go on?") : std::string();
}

void WaitForOperator::onStart(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  waited_ = {};
  last_tick_ = tick.flight.now;
  tick.go_on = false;  // Given for another question.
  tick.say(common::Severity::kInfo, "waits for the operator", question_.get().value_or(""));
}

void WaitForOperator::onResume(tree::TickContext& context) { last_tick_ = flightTick(context).flight.now; }

tree::Status WaitForOperator::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto timeout = timeout_s_.get();
  if (!question_.get()) return fail(context, question_.problem());
  if (!timeout) return fail(context, timeout_s_.problem());
  waited_ = waited_ + (tick.flight.now - std::exchange(last_tick_, tick.flight.now));
  if (std::exchange(tick.go_on, false)) return tree::Status::kSuccess;
  if (timeout->nanoseconds > 0 && waited_.nanoseconds() >= timeout->nanoseconds)
    return fail(context, fmt::format("the operator did not answer for {:.0f} s", waited_.seconds()));
  return tree::Status::kRunning;
}

}  // namespace swiftlet::behaviors
