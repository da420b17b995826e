// A tracked person, and what a laser sees of a map.
#pragma once

#include <cmath>
#include <numbers>

#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/people/seen_points.hpp"

namespace swiftlet::perception::test {

inline common::DynamicObstacle person(int id, double x_m, double y_m, common::Time seen,
                                      const Eigen::Vector2d& velocity = {0, 0}) {
  common::DynamicObstacle obstacle;
  obstacle.id = id;
  obstacle.center_map_m = {x_m, y_m};
  obstacle.radius_m = 0.25;
  obstacle.velocity_map_m_s = velocity;
  obstacle.moving = !velocity.isZero();
  obstacle.last_seen = seen;
  return obstacle;
}

/// What a laser with a beam a degree sees all around.
inline SeenPoints seenFrom(const common::OccupancyGrid& grid, const Eigen::Vector2d& from_map_m) {
  SeenPoints seen{from_map_m, {}, {}};
  for (int degree = 0; degree < 360; ++degree) {
    const double angle_rad = (degree + 0.5) * common::kRadPerDeg - std::numbers::pi;
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    double range_m = 0.1;
    while (common::occupancy::isFree(grid.at(grid.cellAt(from_map_m + range_m * along)))) range_m += 0.02;
    seen.points_map_m.emplace_back((from_map_m + range_m * along).cast<float>());
  }
  return seen;
}

}  // namespace swiftlet::perception::test
