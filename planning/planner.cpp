#include "planning/planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <fmt/format.h>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Point = Eigen::Vector2d;

std::string inWords(const Point& point_m) { return fmt::format("({:.2f}, {:.2f})", point_m.x(), point_m.y()); }

/// What a cell of the inflated zone costs to a vehicle that is leaving it; none: it may not be entered.
std::optional<double> escapeCost(const CostMap& map, CellIndex cell, double from_start_m) {
  constexpr double kNearness = 4.0, kUnknown = 20.0, kOccupied = 50.0;
  if (!map.contains(cell)) return std::nullopt;
  switch (map.stateAt(cell)) {
    case CellState::kFree:
      return 1.0 + kNearness * std::max(0.0, 1.0 - map.obstacleDistance_m(cell) / map.footprint().radius_m());
    case CellState::kUnknown:
      return kUnknown;
    case CellState::kOccupied:
      // Where the hull is, nothing else can be: the map is wrong there.
      if (from_start_m <= map.footprint().hull_radius_m) return kOccupied;
      return std::nullopt;
  }
  SWIFTLET_CHECK(false);
}

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

std::optional<CellPath> escapeFrom(const CostMap& map, CellIndex start, double reach_m) {
  if (!map.contains(start)) return std::nullopt;
  if (map.costAt(start) != CostMap::kLethal) return CellPath{start};

  // A window of its own around the start; a Dijkstra over a few hundred cells.
  const int reach = static_cast<int>(std::ceil(reach_m / map.resolution_m())), width = 2 * reach + 1;
  const auto slot = [&](CellIndex c) { return (c.y - start.y + reach) * width + (c.x - start.x + reach); };
  const auto cellOf = [&](int i) { return CellIndex{start.x - reach + i % width, start.y - reach + i / width}; };
  std::vector<double> cost(static_cast<std::size_t>(width) * width, std::numeric_limits<double>::infinity());
  std::vector<int> from(cost.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[static_cast<std::size_t>(slot(start))] = 0.0;
  open.push({0.0, slot(start)});
  while (!open.empty()) {
    const auto [reached, i] = open.top();
    open.pop();
    if (reached > cost[static_cast<std::size_t>(i)]) continue;
    const CellIndex cell = cellOf(i);
    if (map.costAt(cell) != CostMap::kLethal) {
      CellPath path;
      for (int j = i; j >= 0; j = from[static_cast<std::size_t>(j)]) path.push_back(cellOf(j));
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{cell.x + dx, cell.y + dy};
        if ((dx == 0 && dy == 0) || std::abs(next.x - start.x) > reach || std::abs(next.y - start.y) > reach) continue;
        const double from_start_m = std::hypot(next.x - start.x, next.y - start.y) * map.resolution_m();
        const std::optional<double> step = escapeCost(map, next, from_start_m);
        if (!step || from_start_m > reach_m) continue;
        const double sum = reached + *step * std::hypot(dx, dy);
        const auto j = static_cast<std::size_t>(slot(next));
        if (sum >= cost[j]) continue;
        cost[j] = sum;
        from[j] = i;
        open.push({sum, static_cast<int>(j)});
      }
    }
  }
  return std::nullopt;
}

std::optional<Point> nearestFree(const CostMap& map, const Point& point_map_m, double reach_m) {
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
        const double distance_m = (map.centerOf(cell) - point_map_m).norm();
        if (distance_m >= best_m) continue;
        best_m = distance_m;
        best = map.centerOf(cell);
      }
    }
  }
  return best;
}

tl::expected<CellPath, PlanFailure> admit(const CostMap& map, const Point& start_map_m, const Point& goal_map_m) {
  using Reason = PlanFailure::Reason;
  const auto refuse = [](Reason reason, std::string text, std::optional<Point> nearest = std::nullopt) {
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
