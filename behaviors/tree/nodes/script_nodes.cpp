#include "behaviors/tree/nodes/script_nodes.hpp"

namespace swiftlet::tree {
namespace {

PortManifest codePort(const char* description) {
  return {.name = "code", .type = PortType::kScript, .required = true, .description = description};
}

}  // namespace

NodeManifest ScriptNode::manifest() {
  return {.id = "Script",
          .kind = NodeKind::kAction,
          .ports = {codePort("What is run: `x := 1; y = x + 2`.")},
          .description = "Runs a script."};
}

Status ScriptNode::act(TickContext& context) {
  return code_->run() ? Status::kSuccess : fail(context, "code: " + code_->problem());
}

NodeManifest ScriptCondition::manifest() {
  return {.id = "ScriptCondition",
          .kind = NodeKind::kCondition,
          .ports = {codePort("What is asked: `x > 3`.")},
          .description = "SUCCESS if a script is true, else FAILURE."};
}

Status ScriptCondition::act(TickContext& context) {
  const auto holds = code_->holds();
  if (!holds) return fail(context, "code: " + code_->problem());
  return *holds ? Status::kSuccess : Status::kFailure;
}

}  // namespace swiftlet::tree
