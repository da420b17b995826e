// LogEvent: writes an event into the run's list and onto the page. SUCCESS at once.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

class LogEvent final : public tree::Leaf {
 public:
  explicit LogEvent(const tree::NodeSetup& setup) : Leaf(setup), text_(setup, "text"), severity_(setup, "severity") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<std::string> text_;
  tree::Input<std::string> severity_;
};

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

}  // namespace

void addLogEvent(tree::Registry& registry) { registry.add<LogEvent>(); }

}  // namespace swiftlet::behaviors
