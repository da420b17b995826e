// A node of the mission's tree as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "common/rounding.hpp"
#include "common/world/tree_view.hpp"

namespace swiftlet::web {

/// "3;-1.5", "{goal} = 3;-1.5", or "{goal}" while that entry is not set.
inline std::string textOf(const common::TreePortView& port) {
  if (port.entry.empty()) return port.value.value_or("");
  return "{" + port.entry + "}" + (port.value ? " = " + *port.value : "");
}

/// `whole`: with parent, name and type, which do not change.
inline nlohmann::ordered_json nodeJson(const common::TreeNodeView& node, bool whole) {
  nlohmann::ordered_json json = {{"id", node.id}};
  if (whole) json.update({{"parent", node.parent}, {"name", node.name}, {"type", node.type}});
  auto ports = nlohmann::ordered_json::object();
  for (const common::TreePortView& port : node.ports) ports[port.name] = textOf(port);
  const auto seconds = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(common::rounded(*value, 2)) : nlohmann::ordered_json(nullptr);
  };
  json["status"] = node.status;
  json["ports"] = std::move(ports);
  json["reason"] = node.reason;
  json["began_s"] = seconds(node.began_s);
  json["duration_s"] = seconds(node.duration_s);
  return json;
}

}  // namespace swiftlet::web
