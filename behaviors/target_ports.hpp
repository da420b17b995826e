// Which targets a leaf is about.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "behaviors/ports.hpp"
#include "common/world/targets_layer.hpp"

namespace swiftlet::behaviors {

inline tree::PortManifest targetNamePort() {
  return {.name = "target",
          .type = tree::PortType::kString,
          .default_value = "",
          .description = "Name of the targets, as the profile has it; empty: any."};
}
inline tree::PortManifest targetCountPort() {
  return {.name = "count",
          .type = tree::PortType::kInt,
          .default_value = "1",
          .minimum = 1.0,
          .maximum = 1000.0,
          .description = "Targets that must be found."};
}

inline bool hasName(const common::Target& target, const std::string& name) {
  return name.empty() || target.name == name;
}
inline std::int64_t countFound(const common::TargetsLayer& layer, const std::string& name) {
  return std::count_if(layer.targets.begin(), layer.targets.end(), [&](const common::Target& target) {
    return target.state == common::TargetState::kFound && hasName(target, name);
  });
}
/// "2 of 3 `red` found", "0 of 1 found".
inline std::string foundText(std::int64_t found, std::int64_t count, const std::string& name) {
  return std::to_string(found) + " of " + std::to_string(count) + (name.empty() ? "" : " `" + name + "`") + " found";
}

}  // namespace swiftlet::behaviors
