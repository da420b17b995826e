#include "behaviors/land.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Land::manifest() {
  return {.id = "Land", .kind = tree::NodeKind::kAction, .ports = {}, .description = "Descends where it is and stops."};
}

}  // namespace swiftlet::behaviors
