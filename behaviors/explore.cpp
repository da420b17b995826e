#include "behaviors/explore.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Explore::manifest() {
  return {.id = "Explore",
          .kind = tree::NodeKind::kAction,
          .ports = {clearancePort()},
          .description = "Flies to frontiers of the map until nothing is left to explore."};
}

IntentLeaf::Wish Explore::makeWish(const FlightTick&) {
  const auto clearance_m = clearance_m_.get();
  if (!clearance_m) return {std::nullopt, clearance_m_.problem()};
  return {common::ExploreIntent{*clearance_m}, {}};
}

}  // namespace swiftlet::behaviors
