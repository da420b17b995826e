// The World's layer of the map seen from above: what is known of the place.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/level_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/world/frontier.hpp"

namespace swiftlet::common {

/// The pointers are null only in a layer under construction, never in a World of the autonomy.
struct MapLayer {
  std::shared_ptr<const OccupancyGrid> grid;
  std::shared_ptr<const LevelMap> levels;
  std::shared_ptr<const std::vector<Frontier>> frontiers;
  double explored_area_m2 = 0.0;             ///< Of known free cells, when Explore looked last; 0: it never did.
  std::optional<Localization> localization;  ///< None: the flight was given no map.
};

}  // namespace swiftlet::common
