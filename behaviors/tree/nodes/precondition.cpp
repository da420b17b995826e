#include "behaviors/tree/nodes/precondition.hpp"

namespace swiftlet::tree {

NodeManifest Precondition::manifest() {
  return {.id = "Precondition",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "if",
                     .type = PortType::kScript,
                     .required = true,
                     .description = "Condition under which the child runs; it assigns nothing.",
                     .asked = true},
                    {.name = "else",
                     .default_value = "FAILURE",
                     .description = "Status of the node if the condition is not true.",
                     .names_status = true}},
          .description = "The child if a script is true, else a status."};
}

Precondition::Precondition(const NodeSetup& setup)
    : Composite(setup), if_(setup.port("if").script), else_(setup, "else") {}

bool Precondition::onAsked(const TickContext& context) const {
  const auto holds = if_->holds();
  if (holds && *holds) return Composite::onAsked(context);
  const auto text = else_.get();
  return !holds || !text || *text != "SKIPPED";
}

Status Precondition::run(TickContext& context) {
  if (!isActive(child().status())) {
    const auto holds = if_->holds();
    if (!holds) return fail(context, "if: " + if_->problem());
    if (!*holds) {
      const auto status = answerFrom(else_.get().value_or(""));
      return status ? *status : fail(context, else_.problem());
    }
  }
  return child().tick(context);
}

}  // namespace swiftlet::tree
