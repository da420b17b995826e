#include "behaviors/explore.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Explore::manifest() {
  return {.id = "Explore",
          .kind = tree::NodeKind::kAction,
          .ports = ExplorePorts::manifests(),
          .description = "Flies to frontiers of the map until nothing is left to explore.",
          .details =
              "Within `x_min;y_min;x_max;y_max` if `bounds` are given; out of the building, where too few walls tell "
              "the position, only with `leave_building=\"true\"`.",
          .ends = "SUCCESS when every remaining frontier has a reason"};
}

IntentLeaf::IntentOrProblem Explore::makeIntent(const FlightTick& tick) {
  return ports_.intent(tick.mode, *tick.flight.world);
}

}  // namespace swiftlet::behaviors
