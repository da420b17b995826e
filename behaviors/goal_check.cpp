#include "behaviors/goal_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace swiftlet::behaviors {
namespace {

/// From the point to the nearest occupied cell whose centre is within `radius_m`; infinity when there is none.
double nearestObstacle_m(const common::OccupancyGrid& grid, const Eigen::Vector2d& point_map_m, double radius_m) {
  const Eigen::Vector2d reach(radius_m, radius_m);
  const common::CellIndex first = grid.cellAt(point_map_m - reach), last = grid.cellAt(point_map_m + reach);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      if (!common::occupancy::isOccupied(grid.at({x, y}))) continue;
      nearest_m = std::min(nearest_m, (grid.centerOf({x, y}) - point_map_m).norm());
    }
  }
  return nearest_m <= radius_m ? nearest_m : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string goalProblem(const common::OccupancyGrid& grid, const Eigen::Vector2d& goal_map_m, double hull_radius_m) {
  // No map is so large; beyond it the index of a cell would overflow.
  constexpr double kFarthest_m = 1e5;
  if (!goal_map_m.allFinite() || goal_map_m.cwiseAbs().maxCoeff() > kFarthest_m)
    return "the goal is not a point of the map";
  const std::string point = fmt::format("({:.2f}, {:.2f})", goal_map_m.x(), goal_map_m.y());
  const common::occupancy::Cell cell = grid.at(grid.cellAt(goal_map_m));
  if (common::occupancy::isUnknown(cell)) return point + " is outside the map";
  if (common::occupancy::isOccupied(cell)) return point + " is in an obstacle";
  const double nearest_m = nearestObstacle_m(grid, goal_map_m, hull_radius_m);
  if (std::isinf(nearest_m)) return {};
  return fmt::format("{} is {:.2f} m from an obstacle, the hull needs {:.2f} m", point, nearest_m, hull_radius_m);
}

}  // namespace swiftlet::behaviors
