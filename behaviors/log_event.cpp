#include "behaviors/log_event.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

using tree::PortType;

tree::NodeManifest LogEvent::manifest() {
  return {.id = "LogEvent",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "text", .type = PortType::kString, .required = true, .description = "What happened."},
                    choicePort("severity", common::kSeverities, "How it is shown.")},
          .description = "Writes an event.",
          .details = "Into the run and onto the page.",
          .ends = "SUCCESS at once",
          .may_fail = false};
}

tree::Status LogEvent::act(tree::TickContext& context) {
  const auto text = text_.get();
  const auto severity = severity_.get();
  if (!text) return fail(context, text_.problem());
  if (!severity) return fail(context, severity_.problem());
  flightTick(context).say(chosenOf(common::kSeverities, *severity), *text, {});
  return tree::Status::kSuccess;
}

}  // namespace swiftlet::behaviors
