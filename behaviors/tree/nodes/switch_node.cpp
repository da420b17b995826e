#include "behaviors/tree/nodes/switch_node.hpp"

#include <algorithm>

#include "behaviors/tree/script/operand.hpp"

namespace swiftlet::tree {
namespace {

bool isCase(const std::string& variable, const std::string& value, const Constants* constants) {
  if (variable == value) return true;
  const auto a = numberNamed(variable, constants), b = numberNamed(value, constants);
  return a && b && areEqual(*a, *b);
}

}  // namespace

NodeManifest SwitchNode::manifest(std::size_t cases) {
  NodeManifest manifest{.id = "Switch" + std::to_string(cases),
                        .kind = NodeKind::kControl,
                        .ports = {{.name = "variable", .description = "What is compared."}},
                        .description = "The child of the first case that equals the variable, else the last child.",
                        .least_children = static_cast<int>(cases) + 1,
                        .most_children = static_cast<int>(cases) + 1,
                        .about_children = "one for each case, and one for all else"};
  for (std::size_t i = 1; i <= cases; ++i)
    manifest.ports.push_back({.name = "case_" + std::to_string(i),
                              .description = "The value that chooses child " + std::to_string(i) + "."});
  return manifest;
}

SwitchNode::SwitchNode(const NodeSetup& setup, std::size_t cases)
    : Composite(setup), variable_(setup, "variable"), constants_(setup.constants) {
  for (std::size_t i = 1; i <= cases; ++i) cases_.emplace_back(setup, "case_" + std::to_string(i));
}

std::size_t SwitchNode::chosen() const {
  const auto variable = variable_.get();
  if (!variable) return cases_.size();
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const auto value = cases_[i].get();
    if (value && isCase(*variable, *value, constants_)) return i;
  }
  return cases_.size();
}

std::optional<std::size_t> SwitchNode::alwaysChosen() const {
  const bool fixed =
      variable_.fixed() && std::all_of(cases_.begin(), cases_.end(), [](const auto& c) { return c.fixed(); });
  return fixed ? std::optional(chosen()) : std::nullopt;
}

bool SwitchNode::onAsked(const TickContext& context) const { return child(chosen()).wants(context); }

Status SwitchNode::run(TickContext& context) {
  const std::size_t index = chosen();
  if (!haltOthers(context, index)) return Status::kRunning;
  return child(index).tick(context);
}

}  // namespace swiftlet::tree
