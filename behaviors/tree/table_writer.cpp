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
      "# Nodes of missions\n\nGenerated from the manifests of the nodes by `scripts/nodes`; a test fails when it is "
      "stale. How a tree works\nis in [behaviors](behaviors.md).\n\n"
      "| node | kind | what it does | ends | ports |\n| --- | --- | --- | --- | --- |\n";
  for (const auto& [id, type] : registry.types()) {
    std::string ports;
    for (const PortManifest& port : type.manifest.ports)
      ports += (ports.empty() ? "`" : "; `") + port.name + "`: " + valueText(port);
    const NodeManifest& manifest = type.manifest;
    const std::string what = manifest.description + (manifest.details.empty() ? "" : " " + manifest.details);
    text += "| `" + id + "` | " + toString(manifest.kind);
    for (const std::string& column : {what, manifest.ends, ports}) text += " | " + cell(column);
    text += " |\n";
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
  if (!manifest.details.empty()) text += "  " + manifest.details + "\n";
  if (!manifest.ends.empty()) text += "  Ends: " + manifest.ends + "\n";
  for (const PortManifest& port : manifest.ports)
    text += "  " + port.name + ": " + valueText(port) + "\n" +
            (port.description.empty() ? "" : "      " + port.description + "\n");
  return text;
}

}  // namespace swiftlet::tree
