#include <string>

#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/xml_text.hpp"

namespace swiftlet::tree {
namespace {

const char* tagOf(Direction direction) {
  switch (direction) {
    case Direction::kInput:
      return "input_port";
    case Direction::kOutput:
      return "output_port";
    case Direction::kInOut:
      return "inout_port";
  }
  return "?";
}

/// The port types that Groot2 knows; it shows other types as text.
const char* editorType(PortType type) {
  switch (type) {
    case PortType::kDouble:
      return "double";
    case PortType::kInt:
      return "int";
    case PortType::kBool:
      return "bool";
    case PortType::kDuration:
      return "double";
    case PortType::kAny:
      return "AnyTypeAllowed";
    case PortType::kString:
    case PortType::kScript:
    case PortType::kPoint:
    case PortType::kPoints:
    case PortType::kRectangle:
      return "std::string";
  }
  return "?";
}

void writePort(const PortManifest& port, std::string& text) {
  const std::string tag = tagOf(port.direction);
  text += "      <" + tag + " name=\"" + escaped(port.name) + "\" type=\"" + editorType(port.type) + "\"";
  if (port.default_value) text += " default=\"" + escaped(*port.default_value) + "\"";
  text += ">" + escaped(port.description + " Expected: " + expectedOf(port) + ".") + "</" + tag + ">\n";
}

}  // namespace

std::string writeTreeNodesModel(const Registry& registry) {
  // An editor knows the standard nodes of the format, but not Priority.
  const Registry standard = Registry::standard();
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<root BTCPP_format=\"4\">\n  <TreeNodesModel>\n";
  for (const auto& [id, type] : registry.types()) {
    const NodeManifest& manifest = type.manifest;
    if (standard.find(id) != nullptr && id != "Priority") continue;
    const std::string kind = toString(manifest.kind);
    text += "    <!-- " + manifest.description + " -->\n";
    text += "    <" + kind + " ID=\"" + escaped(id) + "\"" + (manifest.ports.empty() ? "/>\n" : ">\n");
    for (const PortManifest& port : manifest.ports) writePort(port, text);
    if (!manifest.ports.empty()) text += "    </" + kind + ">\n";
  }
  return text + "  </TreeNodesModel>\n</root>\n";
}

}  // namespace swiftlet::tree
