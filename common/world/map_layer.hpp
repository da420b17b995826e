// The World's layer of the map: grid, levels, frontiers, keep-out zones, and the pose in a given map.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/given_map.hpp"
#include "common/level_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "common/world/frontier.hpp"

namespace swiftlet::common {

/// The pointers, but for `given`, are null only in a layer under construction, never in a World of the autonomy.
struct MapLayer {
  /// Made by the flight; while the vehicle is localized, over the given map.
  std::shared_ptr<const OccupancyGrid> grid;
  std::shared_ptr<const LevelMap> levels;
  std::shared_ptr<const std::vector<Frontier>> frontiers;
  double explored_area_m2 = 0.0;             ///< Area of known free cells at the last choice of a viewpoint; 0 before.
  std::optional<Localization> localization;  ///< nullopt: the flight was given no map.
  /// The frame of the given map. nullopt without one, and while the vehicle is not localized in it.
  std::optional<Pose2> T_map_given;
  std::shared_ptr<const std::vector<Polygon>> keep_out = std::make_shared<const std::vector<Polygon>>();
  std::shared_ptr<const OccupancyGrid> flown;  ///< What this flight has seen; without a given map the same as `grid`.
  std::shared_ptr<const GivenMap> given;       ///< Null: the flight was given no map.

  PlaceNames names() const { return PlaceNames::in(T_map_given); }
};

}  // namespace swiftlet::common
