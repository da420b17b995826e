// What exploring a building takes at least: a short tour that sees all of it, found with the whole map known. No
// explorer can expect to fly less; how near it comes is its share of this bound.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "evaluation/exploration/flat_building.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::evaluation {

struct KnownTour {
  double length_m = 0.0;                      ///< From the start through all viewpoints, and home.
  std::vector<Eigen::Vector2d> points_map_m;  ///< The start, the viewpoints in order, and the start.
};

/// Viewpoints that together see every place that the hull can reach, all around, up to the laser's range (greedy set
/// cover), in the order of a travelling-salesman tour; those that are not needed for what is seen on the way are left
/// out again. Not the shortest of all tours: the shortest found. Lengths are over the costs of the map, as
/// explorers count them. `building_map` has all of the building (FlatBuilding::seen) and is passable at the start.
[[nodiscard]] KnownTour knownTour(const FlatBuilding& building, const planning::CostMap& building_map,
                                  const Eigen::Vector2d& start_m, double laser_range_m);

}  // namespace swiftlet::evaluation
