// The World's layer of the map: grid, levels, frontiers, keep-out zones, and the pose in a given map.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/level_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/polygon.hpp"
#include "common/world/frontier.hpp"

namespace swiftlet::common {

/// The pointers are null only in a layer under construction, never in a World of the autonomy.
struct MapLayer {
  std::shared_ptr<const OccupancyGrid> grid;
  std::shared_ptr<const LevelMap> levels;
  std::shared_ptr<const std::vector<Frontier>> frontiers;
  double explored_area_m2 = 0.0;             ///< Area of known free cells at the last choice of a viewpoint; 0 before.
  std::optional<Localization> localization;  ///< None: the flight was given no map.
  std::shared_ptr<const std::vector<Polygon>> keep_out = std::make_shared<const std::vector<Polygon>>();
};

}  // namespace swiftlet::common
