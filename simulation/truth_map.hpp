// The free space that a vehicle can reach, computed from the true world; coverage is measured against it. For
// evaluation only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::simulation {

struct FreeSpaceQuery {
  Eigen::Vector2d start_world_m = Eigen::Vector2d::Zero();
  double hull_radius_m = 0.275;
  double bottom_m = 0.85;  ///< Height band of the hull in flight, in the world's frame.
  double top_m = 1.15;
  double resolution_m = 0.05;
  double max_area_m2 = 10'000.0;  ///< Area at which the flood stops if the world has no walls.
  std::vector<Actor> closed_doors;
};

/// Grids in the world's frame; a cell is 1 for yes, 0 for no.
struct FreeSpace {
  common::TiledGrid<std::uint8_t> reachable;  ///< The centre of the hull can reach the cell from the start.
  /// The hull can cover the cell: it is within the hull's radius of a reachable cell.
  common::TiledGrid<std::uint8_t> covered;
  double reachable_area_m2 = 0.0;
  double covered_area_m2 = 0.0;

  /// The flood was stopped by its bound and not by walls, so that what is covered has no end, and is not computed.
  bool isOpen(const FreeSpaceQuery& query) const { return reachable_area_m2 >= query.max_area_m2; }
};

/// The cells that the centre of the hull can reach from the start, by a flood. All are 0 if the hull does not fit at
/// the start.
common::TiledGrid<std::uint8_t> reachableSpace(const RayCaster& rays, const FreeSpaceQuery& query);

/// Area of the cells that are 1.
double area_m2(const common::TiledGrid<std::uint8_t>& cells);

/// Length of the shortest path from the cell of one point to that of another through cells that are 1, with steps to
/// the eight neighbours; nullopt if there is no path.
std::optional<double> pathLength_m(const common::TiledGrid<std::uint8_t>& cells, const Eigen::Vector2d& from_m,
                                   const Eigen::Vector2d& to_m);

FreeSpace freeSpace(const RayCaster& rays, const FreeSpaceQuery& query);

/// Horizontal distance from a point to the nearest surface that crosses this height, up to limit_m.
double distanceToSurface2d(const RayCaster& rays, const Eigen::Vector2d& point_world_m, double height_world_m,
                           double limit_m);

}  // namespace swiftlet::simulation
