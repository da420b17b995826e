#include <string>

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

std::string writeNodeList(const Registry& registry) {
  std::string text;
  for (const auto& [id, type] : registry.types()) text += id + ": " + type.manifest.description + "\n";
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
