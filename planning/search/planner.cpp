#include "planning/search/planner.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Point = Eigen::Vector2d;

std::string inWords(const Point& point_m) { return fmt::format("({:.2f}, {:.2f})", point_m.x(), point_m.y()); }

}  // namespace

const char* toString(PlanFailure::Reason reason) {
  switch (reason) {
    case PlanFailure::Reason::kStartBlocked:
      return "start blocked";
    case PlanFailure::Reason::kGoalBlocked:
      return "goal blocked";
    case PlanFailure::Reason::kGoalUnseen:
      return "goal never seen";
    case PlanFailure::Reason::kUnreachable:
      return "unreachable";
    case PlanFailure::Reason::kOutsideMap:
      return "outside the map";
  }
  SWIFTLET_CHECK(false, static_cast<int>(reason));
}

std::optional<Point> nearestFree(const CostMap& map, const Point& point_map_m, double reach_m) {
  constexpr double kWithinCell = 0.4;  // From its centre, on either side.
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
        if (map.costAt(cell) == CostMap::kLethal) continue;
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

tl::expected<CellPath, PlanFailure> admit(const CostMap& map, const Point& start_map_m, const Point& goal_map_m) {
  using Reason = PlanFailure::Reason;
  const auto refuse = [](Reason reason, std::string text, const std::optional<Point>& nearest = std::nullopt) {
    return tl::make_unexpected(PlanFailure{reason, std::move(text), nearest});
  };
  if (!start_map_m.allFinite() || !goal_map_m.allFinite())
    return refuse(Reason::kOutsideMap, "start or goal is not a number");
  const CellIndex start = map.cellAt(start_map_m), goal = map.cellAt(goal_map_m);
  if (!map.contains(goal))
    return refuse(Reason::kOutsideMap, fmt::format("goal {} is outside the map", inWords(goal_map_m)),
                  nearestFree(map, goal_map_m));
  if (!map.contains(start))
    return refuse(Reason::kOutsideMap, fmt::format("start {} is outside the map", inWords(start_map_m)));
  if (map.costAt(goal) == CostMap::kLethal) {
    const char* why = map.stateAt(goal) == CellState::kOccupied  ? "is in an obstacle"
                      : map.stateAt(goal) == CellState::kUnknown ? "is in space never seen"
                                                                 : "is too close to an obstacle or to unknown space";
    const std::optional<Point> nearest = nearestFree(map, goal_map_m);
    return refuse(
        map.stateAt(goal) == CellState::kUnknown ? Reason::kGoalUnseen : Reason::kGoalBlocked,
        fmt::format("goal {} {} at clearance {:.2f} m{}", inWords(goal_map_m), why, map.footprint().clearance_m,
                    nearest ? ", the nearest free place is " + inWords(*nearest) : std::string()),
        nearest);
  }
  std::optional<CellPath> escape = escapeFrom(map, start);
  if (!escape)
    return refuse(Reason::kStartBlocked, fmt::format("start {} is shut in at clearance {:.2f} m", inWords(start_map_m),
                                                     map.footprint().clearance_m));
  return *std::move(escape);
}

PlanFailure unreachable(const CostMap& map, const Point& goal_map_m) {
  return {PlanFailure::Reason::kUnreachable,
          fmt::format("goal {} is unreachable at clearance {:.2f} m", inWords(goal_map_m), map.footprint().clearance_m),
          std::nullopt};
}

}  // namespace swiftlet::planning
