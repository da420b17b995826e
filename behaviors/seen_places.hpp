// Which places of the map the camera has looked at, and from where to look at one that it has not.
//
// The laser sees all around and soon leaves nothing to explore; the camera sees a sector of a few metres. Like the
// nearest frontier of exploration, the nearest unseen place is the next to look at.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/goal.hpp"
#include "common/intent.hpp"
#include "common/occupancy_grid.hpp"
#include "common/tiled_grid.hpp"
#include "common/time.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::behaviors {

/// The area of a search.
struct SearchArea {
  double range_m = 3.0;                     ///< A place counts as seen from at most this far.
  double clearance_m = 0.10;                ///< Between hull and obstacle, of places to look from.
  std::optional<common::MapBounds> bounds;  ///< Places outside are not searched.
  bool leave_building = false;              ///< Places to look from may be far from everything.
};

/// One thread.
class SeenPlaces {
 public:
  SeenPlaces() : places_(kCell_m, 0) {}

  /// Marks what the newest frame of the layer shows. The same frame is taken once.
  void see(const common::Map3dLayer& layer, const common::OccupancyGrid& grid, double range_m);
  bool isSeen(const Eigen::Vector2d& place_map_m) const { return places_.at(places_.cellAt(place_map_m)) != 0; }
  /// It is not searched any more, and neither are its neighbours.
  void giveUp(const Eigen::Vector2d& place_map_m);

  /// A place that the camera has not seen, and a pose to look at it from.
  struct Look {
    Eigen::Vector2d place_map_m;
    common::Pose2 from_map;
  };
  /// For the nearest place to `here_map_m`; nullopt if all is seen. Places that cannot be looked at are given up. `map`
  /// may be null.
  std::optional<Look> next(const Eigen::Vector2d& here_map_m, const common::OccupancyGrid& grid,
                           const common::GoalMap* map, const SearchArea& area);

 private:
  /// Side of a place; small targets stand more closely to each other, but a frame that shows one shows its neighbour.
  static constexpr double kCell_m = 0.25;
  /// From a free place at that distance, the nearest to the vehicle; only from one that the camera has seen itself if
  /// `from_seen`.
  std::optional<Look> lookAt(const Eigen::Vector2d& place_map_m, double from_m, bool from_seen,
                             const Eigen::Vector2d& here_map_m, const common::OccupancyGrid& grid,
                             const common::GoalMap* map, const SearchArea& area) const;
  bool isAskedFor(common::CellIndex cell, const common::OccupancyGrid& grid, const SearchArea& area) const;
  std::optional<Eigen::Vector2d> nearestUnseen(const Eigen::Vector2d& here_map_m, const common::OccupancyGrid& grid,
                                               const SearchArea& area) const;

  common::TiledGrid<std::uint8_t> places_;  ///< 1: seen or given up.
  std::optional<common::Time> last_frame_;
};

}  // namespace swiftlet::behaviors
