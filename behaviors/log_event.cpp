#include "behaviors/log_event.hpp"

namespace swiftlet::behaviors {

using common::Severity;
using tree::PortType;

tree::NodeManifest LogEvent::manifest() {
  return {.id = "LogEvent",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "text", .type = PortType::kString, .required = true, .description = "What happened."},
                    {.name = "severity",
                     .type = PortType::kString,
                     .default_value = "info",
                     .description = "How it is shown.",
                     .choices = {"info", "warning", "error"}}},
          .description = "Writes an event."};
}

tree::Status LogEvent::act(tree::TickContext& context) {
  const auto text = text_.get();
  const auto severity = severity_.get();
  if (!text) return fail(context, text_.problem());
  if (!severity) return fail(context, severity_.problem());
  FlightTick& tick = flightTick(context);
  const Severity shown = *severity == "error"     ? Severity::kError
                         : *severity == "warning" ? Severity::kWarning
                                                  : Severity::kInfo;
  tick.flight.events.push_back({tick.flight.now, shown, "mission", *text, {}});
  return tree::Status::kSuccess;
}

}  // namespace swiftlet::behaviors
