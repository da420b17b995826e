#include <map>
#include <string>
#include <string_view>

#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {
namespace {

/// A bar would end the cell of a table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

/// What the attribute may be, and whether it must be given.
std::string valueText(const PortManifest& port) {
  std::string text = expectedOf(port);
  if (port.direction == Direction::kOutput) text += ", written";
  if (port.direction == Direction::kInOut) text += ", read and written";
  if (port.required) text += ", required";
  if (port.default_value && !port.default_value->empty()) text += ", " + *port.default_value + " if not given";
  return text;
}

}  // namespace

std::string writeNodeTable(const Registry& registry) {
  std::string text =
      "# Nodes of missions\n\nMade from the node registry by `swiftlet nodes --markdown`; a test fails when it is "
      "stale. What they "
      "mean is in\n[behaviors](behaviors.md).\n\n| node | kind | what it does | ports |\n| --- | --- | --- | --- |\n";
  for (const auto& [id, type] : registry.types()) {
    std::string ports;
    for (const PortManifest& port : type.manifest.ports)
      ports += (ports.empty() ? "`" : "; `") + port.name + "`: " + valueText(port);
    text += "| `" + id + "` | " + toString(type.manifest.kind) + " | " + cell(type.manifest.description) + " | " +
            cell(ports) + " |\n";
  }
  return text;
}

const NodeManifest& subTreeManifest() {
  static const NodeManifest kSubTree = {
      .id = "SubTree",
      .ports = {{.name = "ID", .required = true, .description = "The ID of a <BehaviorTree>."},
                {.name = "_autoremap",
                 .type = PortType::kBool,
                 .default_value = "false",
                 .description = "Whether every entry that is not given is that of the same name around the SubTree."}},
      .description =
          "Runs another tree, with entries of its own; any other attribute is an entry of that tree, and "
          "gives it a text or an entry {x} of this one."};
  return kSubTree;
}

std::string writeNodeList(const Registry& registry) {
  std::map<std::string_view, std::string_view> lines;
  for (const auto& [id, type] : registry.types()) lines.emplace(id, type.manifest.description);
  lines.emplace(subTreeManifest().id, subTreeManifest().description);
  std::string text;
  for (const auto& [id, description] : lines) text.append(id).append(": ").append(description).append("\n");
  return text;
}

std::string writeNodeHelp(const NodeManifest& manifest) {
  std::string text = manifest.id + ": " + manifest.description + "\n";
  for (const PortManifest& port : manifest.ports)
    text += "  " + port.name + ": " + valueText(port) + "\n" +
            (port.description.empty() ? "" : "      " + port.description + "\n");
  return text;
}

}  // namespace swiftlet::tree
