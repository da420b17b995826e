// How well a map agrees with the true building.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::evaluation {

/// The share of the free space a vehicle can cover that the map knows, in [0, 1]; 1 if there is no such space.
/// `T_world_map` places the map in the world. Cells that the map calls occupied count as known: if they are free, this
/// is an error of the map, measured by `wallError`, and not of the exploration.
double coverage(const common::OccupancyGrid& map, const common::Pose2& T_world_map,
                const simulation::FreeSpace& free_space);

/// Distance from the centres of the map's occupied cells to the nearest true surface at one height.
struct WallError {
  double median_m = 0.0;
  double p95_m = 0.0;
  double max_m = 0.0;  ///< Distances are capped at kLimit_m.
  std::size_t cells = 0;
  /// Farther, a cell has no wall to be compared with.
  static constexpr double kLimit_m = 1.0;
};

/// nullopt if the map has no occupied cell. Closed doors are surfaces, too.
std::optional<WallError> wallError(const common::OccupancyGrid& map, const common::Pose2& T_world_map,
                                   const simulation::RayCaster& rays, double height_world_m,
                                   std::span<const simulation::Actor> closed_doors = {});

}  // namespace swiftlet::evaluation
