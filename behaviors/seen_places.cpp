#include "behaviors/seen_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "common/line_of_sight.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::behaviors {
namespace {

/// A place is seen where both its floor and what stands on a table there are in the picture.
constexpr double kFloor_m = 0.10, kTable_m = 0.90;
/// What stands at the place itself hides nothing.
constexpr double kPlaceNear_m = 0.35;
/// Single unseen places between seen ones are the shadows of legs and of noise.
constexpr int kLeastNeighbours = 5;
/// Distances to look from, the best first: from nearer the floor is below the picture of a camera that looks ahead.
constexpr double kLookFrom_m[] = {2.0, 2.4, 1.7};
constexpr int kLookDirections = 16;  ///< Every 22 degrees: finer than half of a camera's angle of view.
/// Within this distance there must be something for the laser, as for exploring.
constexpr double kWalls_m = 5.0;

bool isInPicture(const common::PinholeCamera& camera, const Eigen::Vector3d& point_camera_m) {
  if (!(point_camera_m.x() > 0.3)) return false;
  const Eigen::Vector2d pixel = camera.pixel(point_camera_m);
  return (pixel.array() >= 0.0).all() && pixel.x() <= camera.width_px - 1 && pixel.y() <= camera.height_px - 1;
}

bool hasWallsAround(const common::OccupancyGrid& grid, const Eigen::Vector2d& place_map_m) {
  int walls = 0;
  for (int i = 0; i < kLookDirections; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kLookDirections;
    const Eigen::Vector2d end = place_map_m + kWalls_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    if (!common::isInSight(grid, place_map_m, end, 0.0)) ++walls;
  }
  return 4 * walls >= kLookDirections;
}

}  // namespace

void SeenPlaces::see(const common::Map3dLayer& layer, const common::OccupancyGrid& grid, double range_m) {
  if (!layer.frame || last_frame_ == layer.frame->stamps.measured) return;
  last_frame_ = layer.frame->stamps.measured;
  const common::Pose3 T_camera_map = layer.T_map_camera.inverse();
  const Eigen::Vector2d from_map_m = layer.T_map_camera.position_m.head<2>();
  const common::CellIndex low = places_.cellAt(from_map_m - Eigen::Vector2d::Constant(range_m));
  const common::CellIndex high = places_.cellAt(from_map_m + Eigen::Vector2d::Constant(range_m));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const Eigen::Vector2d place = places_.centerOf({x, y});
      if (places_.at({x, y}) != 0 || (place - from_map_m).norm() > range_m) continue;
      const auto seenAt = [&](double z_m) {
        return isInPicture(layer.frame->camera, T_camera_map * Eigen::Vector3d(place.x(), place.y(), z_m));
      };
      if (seenAt(kFloor_m) && seenAt(kTable_m) && common::isInSight(grid, from_map_m, place, kPlaceNear_m))
        places_.set({x, y}, 1);
    }
}

void SeenPlaces::giveUp(const Eigen::Vector2d& place_map_m) {
  const common::CellIndex middle = places_.cellAt(place_map_m);
  for (int y = middle.y - 1; y <= middle.y + 1; ++y)
    for (int x = middle.x - 1; x <= middle.x + 1; ++x) places_.set({x, y}, 1);
}

bool SeenPlaces::isAskedFor(common::CellIndex cell, const common::OccupancyGrid& grid, const SearchArea& area) const {
  if (places_.at(cell) != 0) return false;
  const Eigen::Vector2d place = places_.centerOf(cell);
  if (area.bounds && !area.bounds->contains(place)) return false;
  return common::occupancy::isFree(grid.at(grid.cellAt(place)));
}

std::optional<Eigen::Vector2d> SeenPlaces::nearestUnseen(const Eigen::Vector2d& here_map_m,
                                                         const common::OccupancyGrid& grid,
                                                         const SearchArea& area) const {
  const common::CellRect known = knownExtent(grid);
  std::optional<Eigen::Vector2d> nearest;
  if (known.empty()) return nearest;
  const common::CellIndex low = places_.cellAt(grid.centerOf(known.begin)),
                          high = places_.cellAt(grid.centerOf(known.end));
  double least_m = std::numeric_limits<double>::infinity();
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const double away_m = (places_.centerOf({x, y}) - here_map_m).norm();
      if (away_m >= least_m || !isAskedFor({x, y}, grid, area)) continue;
      int neighbours = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) neighbours += isAskedFor({x + i, y + j}, grid, area) ? 1 : 0;
      if (neighbours < kLeastNeighbours) continue;
      nearest = places_.centerOf({x, y});
      least_m = away_m;
    }
  return nearest;
}

/// What the laser's plane misses is known only where the camera has looked, so such places to look from come first.
std::optional<SeenPlaces::Look> SeenPlaces::next(const Eigen::Vector2d& here_map_m, const common::OccupancyGrid& grid,
                                                 const common::GoalMap* map, const SearchArea& area) {
  while (const auto place = nearestUnseen(here_map_m, grid, area)) {
    for (const bool from_seen : {true, false})
      for (const double from_m : kLookFrom_m)
        if (const auto look = lookAt(*place, from_m, from_seen, here_map_m, grid, map, area)) return look;
    giveUp(*place);
  }
  return std::nullopt;
}

std::optional<SeenPlaces::Look> SeenPlaces::lookAt(const Eigen::Vector2d& place_map_m, double from_m, bool from_seen,
                                                   const Eigen::Vector2d& here_map_m, const common::OccupancyGrid& grid,
                                                   const common::GoalMap* map, const SearchArea& area) const {
  std::optional<Look> best;
  if (from_m > area.range_m) return best;
  for (int i = 0; i < kLookDirections; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kLookDirections;
    const Eigen::Vector2d from = place_map_m - from_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    if (from_seen && !isSeen(from)) continue;
    if (map != nullptr && map->stateAt(from, area.clearance_m) != common::PlaceState::kFree) continue;
    if (!common::isInSight(grid, from, place_map_m, kPlaceNear_m)) continue;
    if (!area.leave_building && !hasWallsAround(grid, from)) continue;
    if (best && (from - here_map_m).norm() >= (best->from_map.position_m() - here_map_m).norm()) continue;
    best = Look{place_map_m, {from.x(), from.y(), angle_rad}};
  }
  return best;
}

}  // namespace swiftlet::behaviors
