#include "behaviors/explore.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Explore::manifest() {
  return {
      .id = "Explore",
      .kind = tree::NodeKind::kAction,
      .ports = {clearancePort(),
                {.name = "bounds",
                 .type = tree::PortType::kRectangle,
                 .description = "In the map frame, whose origin is the take-off pose; what lies outside is left "
                                "unexplored. Not given: no bounds."},
                {.name = "leave_building",
                 .type = tree::PortType::kBool,
                 .default_value = "false",
                 .description = "Explore also where the laser would see too little to know the position, as outside "
                                "an open door."}},
      .description = "Flies to frontiers of the map until nothing is left to explore."};
}

IntentLeaf::IntentOrProblem Explore::makeIntent(const FlightTick& tick) {
  const auto clearance_m = clearance_m_.get();
  if (!clearance_m) return {std::nullopt, clearance_m_.problem()};
  const auto leave_building = leave_building_.get();
  if (!leave_building) return {std::nullopt, leave_building_.problem()};
  common::ExploreIntent intent{*clearance_m, std::nullopt, *leave_building, tick.mode};
  if (bounds_.given()) {
    const auto bounds = bounds_.get();
    if (!bounds) return {std::nullopt, bounds_.problem()};
    intent.bounds = common::MapBounds{{bounds->x_min, bounds->y_min}, {bounds->x_max, bounds->y_max}};
  }
  return {intent, {}};
}

}  // namespace swiftlet::behaviors
