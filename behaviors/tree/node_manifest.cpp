#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

const char* toString(NodeKind kind) {
  switch (kind) {
    case NodeKind::kAction:
      return "Action";
    case NodeKind::kCondition:
      return "Condition";
    case NodeKind::kControl:
      return "Control";
    case NodeKind::kDecorator:
      return "Decorator";
  }
  return "?";
}

const PortManifest* NodeManifest::findPort(std::string_view name) const {
  for (const PortManifest& port : ports)
    if (port.name == name) return &port;
  return nullptr;
}

}  // namespace swiftlet::tree
