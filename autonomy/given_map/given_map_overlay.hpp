// The flight in a map that was given: once the vehicle is localized, the given map lies under the one that the flight
// makes, in the frame `map`. Paths, goals and the pictures use both; where the flight has seen a cell, its own map
// counts.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "autonomy/given_map/map_changes.hpp"
#include "autonomy/given_map/resampled_map.hpp"
#include "common/geometry.hpp"
#include "common/given_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

using common::GivenMap;

/// One thread. Without a given map the grid stays the same object.
class GivenMapOverlay {
 public:
  /// `given` may be null and is read only here.
  GivenMapOverlay(const GivenMap* given, common::EventLog& log);

  /// Another map is the given one from the next update on.
  void load(const GivenMap& given);

  /// `T_map_body` is the pose for which the two frames have to agree best, at `now`.
  void update(common::Time now, const common::Pose2& T_map_body, const common::Pose2& T_map_odom,
              const std::optional<common::Localization>& localization,
              const std::shared_ptr<const common::OccupancyGrid>& flown);

  /// The map of the flight over the given one; null before the first update.
  std::shared_ptr<const common::OccupancyGrid> grid() const { return grid_; }
  /// The same for paths: walls that only the given map has are without their outermost cells, so that doors which are
  /// known to a cell are not narrowed.
  std::shared_ptr<const common::OccupancyGrid> gridForPaths() const { return for_paths_; }
  /// The map of the flight alone; null before the first update.
  const std::shared_ptr<const common::OccupancyGrid>& flown() const { return flown_; }
  /// The given map; null without one.
  const std::shared_ptr<const GivenMap>& given() const { return given_; }
  /// The frame of the given map, smoothed, and moved in steps of some centimetres at the vehicle, so that plans live
  /// longer than a scan. nullopt while the vehicle is not localized.
  const std::optional<common::Pose2>& T_map_given() const { return T_map_given_; }

 private:
  bool follow(common::Time now, const common::Pose2& T_map_body, const common::Pose2& T_map_given);
  void lay();

  std::shared_ptr<const GivenMap> given_;
  std::optional<ResampledMap> resampled_;  ///< Of the given map, once the resolution of the flight's is known.
  std::optional<common::Pose2> smoothed_;  ///< T_map_given.
  std::optional<common::Pose2> T_map_given_;
  common::Time updated_;
  common::OccupancyGrid laid_;  ///< The given map in the cells of `map`.
  std::shared_ptr<const common::OccupancyGrid> flown_, grid_, for_paths_;
  MapChanges changes_;
};

}  // namespace swiftlet::autonomy
