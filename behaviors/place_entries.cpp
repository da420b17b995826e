#include "behaviors/place_entries.hpp"

#include <cstddef>
#include <utility>

#include "behaviors/tree/value.hpp"
#include "common/topological_map.hpp"

namespace swiftlet::behaviors {

tree::ParseOptions parseOptionsOf(const MissionLimits& limits) {
  tree::ParseOptions options;
  if (limits.places) options.host_entries = limits.places->names();
  return options;
}

void setPlaces(const MissionLimits& limits, tree::Tree& tree) {
  if (!limits.places) return;
  for (const common::MapPlace& place : limits.places->places)
    tree.set(place.name, tree::Point{place.x_m, place.y_m, std::nullopt});
  for (const common::MapPassage& passage : limits.places->passages)
    tree.set(passage.name, tree::Point{passage.x_m, passage.y_m, passage.z_m});
  for (const common::DangerZone& zone : limits.places->danger_zones) {
    tree::Points corners;
    for (std::size_t i = 0; i + 1 < zone.corners_m.size(); i += 2)
      corners.points.push_back({zone.corners_m[i], zone.corners_m[i + 1], std::nullopt});
    tree.set(zone.name, std::move(corners));
  }
}

}  // namespace swiftlet::behaviors
