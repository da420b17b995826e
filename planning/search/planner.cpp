#include "planning/search/planner.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Point = Eigen::Vector2d;

}  // namespace

std::optional<Point> nearestPlace(const CostMap& map, const Point& point_map_m, double reach_m,
                                  const std::function<bool(CellIndex)>& isSuch) {
  // Greatest distance of a place from its cell's centre in x and y, in cells.
  constexpr double kWithinCell = 0.4;
  const CellIndex center = map.cellAt(point_map_m);
  const int reach = static_cast<int>(std::ceil(reach_m / map.resolution_m()));
  std::optional<Point> best;
  double best_m = reach_m;
  for (int ring = 0; ring <= reach; ++ring) {
    if (best && (ring - 1) * map.resolution_m() > best_m) break;
    for (int dy = -ring; dy <= ring; ++dy) {
      const int step = std::abs(dy) == ring || ring == 0 ? 1 : 2 * ring;
      for (int dx = -ring; dx <= ring; dx += step) {
        const CellIndex cell{center.x + dx, center.y + dy};
        if (!isSuch(cell)) continue;
        const Point center_m = map.centerOf(cell), within = Point::Constant(kWithinCell * map.resolution_m());
        const Point place_m = point_map_m.cwiseMax(center_m - within).cwiseMin(center_m + within);
        const double distance_m = (place_m - point_map_m).norm();
        if (distance_m >= best_m) continue;
        best_m = distance_m;
        best = place_m;
      }
    }
  }
  return best;
}

std::optional<Point> nearestFree(const CostMap& map, const Point& point_map_m, double reach_m) {
  return nearestPlace(map, point_map_m, reach_m, [&](CellIndex cell) { return map.costAt(cell) != CostMap::kLethal; });
}

}  // namespace swiftlet::planning
