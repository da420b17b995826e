#include "behaviors/tree/nodes/test_node.hpp"

namespace swiftlet::tree {

NodeManifest TestNode::manifest() {
  const auto script = [](const char* name, const char* when) {
    return PortManifest{.name = name, .type = PortType::kScript, .description = when};
  };
  return {.id = "TestNode",
          .kind = NodeKind::kAction,
          .ports = {{.name = "return_status",
                     .default_value = "SUCCESS",
                     .description = "Answer of the node.",
                     .names_status = true},
                    {.name = "async_delay_msec",
                     .type = PortType::kDuration,
                     .default_value = "0",
                     .minimum = 0,
                     .description = "Time for which the node is RUNNING before it answers."},
                    script("success_script", "Runs before SUCCESS."),
                    script("failure_script", "Runs before FAILURE."),
                    script("post_script", "Runs before either.")},
          .description = "A stand-in that answers what it is told to.",
          .may_skip = true};
}

TestNode::TestNode(const NodeSetup& setup)
    : Leaf(setup),
      return_status_(setup, "return_status"),
      async_delay_msec_(setup, "async_delay_msec"),
      success_script_(setup.port("success_script").script),
      failure_script_(setup.port("failure_script").script),
      post_script_(setup.port("post_script").script) {}

Release TestNode::onSuspend(TickContext& context) {
  watch_.stop(context.now_ns);
  return Release::kReleased;
}

bool TestNode::onAsked(const TickContext&) const { return return_status_.get().value_or("") != "SKIPPED"; }

Status TestNode::act(TickContext& context) {
  const auto delay = async_delay_msec_.get();
  if (!delay) return fail(context, async_delay_msec_.problem());
  if (watch_.elapsed_ns(context.now_ns) < delay->nanoseconds) return Status::kRunning;
  const auto status = answerFrom(return_status_.get().value_or(""));
  if (!status) return fail(context, return_status_.problem());
  if (*status == Status::kRunning) return *status;
  const bool ran = run(context, *status == Status::kSuccess ? success_script_ : failure_script_);
  return run(context, post_script_) && ran && *status == Status::kSuccess ? Status::kSuccess : Status::kFailure;
}

bool TestNode::run(TickContext& context, Script* script) const {
  if (script == nullptr || script->run()) return true;
  (void)fail(context, script->problem());
  return false;
}

}  // namespace swiftlet::tree
