#include "behaviors/land.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Land::manifest() {
  return {.id = "Land",
          .kind = tree::NodeKind::kAction,
          .ports = {},
          .description = "Descends and stops, at the nearest place where the hull stands on one level."};
}

}  // namespace swiftlet::behaviors
