#include "planning/costs/open_place.hpp"

#include <cmath>
#include <numbers>

namespace swiftlet::planning {

using Eigen::Vector2d;

namespace {

constexpr int kDirections = 32;  ///< Every 11 degrees: 0.4 m apart at 2 m.
/// Loss per metre of path, in metres of distance to the walls: an estimate that is no longer measured drifts by 0.1 m/s
/// (docs/decisions/fusion.md#062), which is about this share of a path flown at 0.3 m/s.
constexpr double kLossPerMetre = 0.25;

}  // namespace

Vector2d displacementToOpenPlace_m(const CostMap& map, const Vector2d& from_map_m, double reach_m) {
  Vector2d best_m = Vector2d::Zero();
  const double here_m = map.clearance().at_m(from_map_m, Against::kObstacles);
  double best_score_m = here_m;
  for (int direction = 0; direction < kDirections; ++direction) {
    const double angle_rad = 2.0 * std::numbers::pi * direction / kDirections;
    const Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    double before_m = here_m;
    for (double length_m = map.resolution_m(); length_m <= reach_m; length_m += map.resolution_m()) {
      const common::CellIndex cell = map.cellAt(from_map_m + length_m * along);
      const double distance_m = map.clearance().at_m(cell, Against::kObstacles);
      // Out of a place that is too near to a wall only away from it.
      if (map.costAt(cell) == CostMap::kLethal && (distance_m <= before_m || map.states().at(cell) != CellState::kFree))
        break;
      before_m = distance_m;
      const double score_m = distance_m - kLossPerMetre * length_m;
      if (score_m <= best_score_m + 1e-9) continue;
      best_score_m = score_m;
      best_m = length_m * along;
    }
  }
  return best_m;
}

}  // namespace swiftlet::planning
