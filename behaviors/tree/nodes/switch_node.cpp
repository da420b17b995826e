#include "behaviors/tree/nodes/switch_node.hpp"

#include "behaviors/tree/script/operand.hpp"

namespace swiftlet::tree {

NodeManifest SwitchNode::manifest(std::size_t cases) {
  NodeManifest manifest{.id = "Switch" + std::to_string(cases),
                        .kind = NodeKind::kControl,
                        .ports = {{.name = "variable", .required = true, .description = "What is compared."}},
                        .description = "The child of the first case that equals the variable, else the last child."};
  for (std::size_t i = 1; i <= cases; ++i)
    manifest.ports.push_back({.name = "case_" + std::to_string(i),
                              .required = true,
                              .description = "The value that chooses child " + std::to_string(i) + "."});
  return manifest;
}

SwitchNode::SwitchNode(const NodeSetup& setup, std::size_t cases) : Composite(setup), variable_(setup, "variable") {
  for (std::size_t i = 1; i <= cases; ++i) cases_.emplace_back(setup, "case_" + std::to_string(i));
}

std::string SwitchNode::checkBuilt() const {
  if (count() == cases_.size() + 1) return {};
  return "has " + std::to_string(count()) + (count() == 1 ? " child" : " children") + ", expected " +
         std::to_string(cases_.size() + 1) + ": one for each case, and one for all else";
}

std::optional<std::size_t> SwitchNode::chosen() const {
  const auto variable = variable_.get();
  if (!variable) return std::nullopt;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const auto value = cases_[i].get();
    if (!value) return std::nullopt;
    const Operand a = std::string_view(*variable), b = std::string_view(*value);
    const auto number_a = numberOf(a), number_b = numberOf(b);
    if (*variable == *value || (number_a && number_b && *number_a == *number_b)) return i;
  }
  return cases_.size();
}

bool SwitchNode::onAsked(const TickContext& context) const {
  const auto index = chosen();
  return !index || child(*index).wants(context);
}

Status SwitchNode::run(TickContext& context) {
  const auto index = chosen();
  if (!index) {
    std::string problem = variable_.problem();
    for (const auto& value : cases_)
      if (variable_.get() && !value.get()) problem = value.problem();
    return endWith(context, fail(context, problem));
  }
  if (!haltOthers(context, *index)) return Status::kRunning;
  return child(*index).tick(context);
}

}  // namespace swiftlet::tree
