#include "behaviors/explore.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Explore::manifest() {
  return {.id = "Explore",
          .kind = tree::NodeKind::kAction,
          .ports = ExplorePorts::manifests(),
          .description = "Flies to frontiers of the map until nothing is left to explore."};
}

IntentLeaf::IntentOrProblem Explore::makeIntent(const FlightTick& tick) {
  return ports_.intent(tick.mode, *tick.flight.world);
}

}  // namespace swiftlet::behaviors
