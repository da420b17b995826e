// Paths through cells that the planners must not cross: out of the lethal zone, and towards a goal behind an
// obstruction. Both are a Dijkstra search with prices that avoid such cells as long as there is another path.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <unordered_set>

#include "planning/search/edge_cost.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;

/// The cheapest chain of cells within the window from the start to the first cell with isEnd(cell). `price` is that of
/// a straight step from a cell to its neighbour; nullopt: the step is forbidden. A diagonal step costs sqrt(2) times as
/// much.
std::optional<CellPath> cheapest(const CellRect& window, CellIndex start,
                                 const std::function<std::optional<double>(CellIndex, CellIndex)>& price,
                                 const std::function<bool(CellIndex)>& isEnd) {
  const int width = window.width();
  const auto slot = [&](CellIndex c) { return (c.y - window.begin.y) * width + (c.x - window.begin.x); };
  const auto cellOf = [&](int i) { return CellIndex{window.begin.x + i % width, window.begin.y + i / width}; };
  std::vector<double> cost(static_cast<std::size_t>(width) * window.height(), std::numeric_limits<double>::infinity());
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
    if (isEnd(cell)) {
      CellPath path;
      for (int j = i; j >= 0; j = from[static_cast<std::size_t>(j)]) path.push_back(cellOf(j));
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{cell.x + dx, cell.y + dy};
        if ((dx == 0 && dy == 0) || !window.contains(next)) continue;
        const std::optional<double> step = price(cell, next);
        if (!step) continue;
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

/// Whether the planners come from the cell to places farther than `reach_m` from `start`.
bool leadsOn(const CostMap& map, CellIndex cell, CellIndex start, double reach_m) {
  std::vector<int> open{map.indexOf(cell)};
  std::unordered_set<int> reached(open.begin(), open.end());
  while (!open.empty()) {
    const int from = open.back();
    open.pop_back();
    const CellIndex at = map.cellOf(from);
    if (std::hypot(at.x - start.x, at.y - start.y) * map.resolution_m() > reach_m) return true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int to = from + dy * map.rect().width() + dx;
        if (edgeCost(map, from, dx, dy) != kNoEdge && reached.insert(to).second) open.push_back(to);
      }
  }
  return false;
}

}  // namespace

std::optional<CellPath> escapeFrom(const CostMap& map, CellIndex start, double reach_m) {
  // Prices by what is likely there: away from obstacles first, through unknown cells only where no free path of twenty
  // times the length exists, and through occupied ones last, as these are noise only where the hull itself stands.
  constexpr double kNearness = 4.0, kUnknown = 20.0, kOccupied = 50.0;
  if (!map.rect().contains(start)) return std::nullopt;
  const int reach = static_cast<int>(std::ceil(reach_m / map.resolution_m()));
  // Where the planners may start, the hull keeps half of its clearance, as it may on its trail
  // (docs/decisions/planning.md#010).
  const bool lethal = map.costAt(start) == CostMap::kLethal;
  const double least_m = lethal ? 0.0 : map.footprint().hull_radius_m + 0.5 * map.footprint().clearance_m;
  // A keep-out zone over the vehicle may be as large as the room; farther away only its cells count as open.
  const bool kept_out = map.isKeptOut(map.indexOf(start));
  const auto obstacle_m = [&](CellIndex cell) { return map.clearance().at_m(cell, Against::kObstacles); };
  const auto price = [&](CellIndex, CellIndex cell) -> std::optional<double> {
    const double from_start_m = std::hypot(cell.x - start.x, cell.y - start.y) * map.resolution_m();
    if (!map.rect().contains(cell)) return std::nullopt;
    if (from_start_m > reach_m) {
      if (!kept_out || obstacle_m(cell) < map.footprint().radius_m()) return std::nullopt;
      return map.states().at(cell) == CellState::kFree ? std::optional(1.0) : std::nullopt;
    }
    switch (map.states().at(cell)) {
      case CellState::kFree:
        if (obstacle_m(cell) < least_m) return std::nullopt;
        return 1.0 + kNearness * std::max(0.0, 1.0 - obstacle_m(cell) / map.footprint().radius_m());
      case CellState::kUnknown:
        if (!lethal) return std::nullopt;
        return kUnknown;
      case CellState::kOccupied:
        // The hull is at this cell, so it cannot be occupied: the map is wrong.
        if (lethal && from_start_m <= map.footprint().hull_radius_m) return kOccupied;
    }
    return std::nullopt;
  };
  const CellRect near{{start.x - reach, start.y - reach}, {start.x + reach + 1, start.y + reach + 1}};
  const CellRect window = kept_out ? map.rect() : near;
  const auto passable = [&](CellIndex cell) { return map.costAt(cell) != CostMap::kLethal; };
  auto escape = cheapest(window, start, price,
                         [&](CellIndex cell) { return passable(cell) && leadsOn(map, cell, start, reach_m); });
  return escape ? escape : cheapest(window, start, price, passable);
}

std::vector<Eigen::Vector2d> escapePoints_map_m(const CostMap& map, const Eigen::Vector2d& start_map_m) {
  std::vector<Eigen::Vector2d> points{start_map_m};
  const std::optional<CellPath> escape = escapeFrom(map, map.cellAt(start_map_m));
  for (std::size_t i = 1; escape && i < escape->size(); ++i) points.push_back(map.centerOf((*escape)[i]));
  return points;
}

std::optional<BlockedPath> blockedPath(const CostMap& map, CellIndex start, CellIndex goal) {
  // A lethal cell that is not occupied is much cheaper than an occupied one: it may be a narrow gap, or a person who
  // will leave.
  constexpr double kNarrow = 4.0, kOccupied = 200.0;
  const std::optional<CellPath> escape = escapeFrom(map, start);
  if (!escape || !map.rect().contains(goal)) return std::nullopt;
  const auto isLethal = [&](CellIndex cell) { return map.costAt(cell) == CostMap::kLethal; };
  const auto price = [&](CellIndex from, CellIndex to) -> std::optional<double> {
    if (map.states().at(to) == CellState::kUnknown) return std::nullopt;
    // Like the planners, this cuts no corner.
    const bool diagonal = from.x != to.x && from.y != to.y;
    if (diagonal && (isLethal({from.x, to.y}) || isLethal({to.x, from.y}))) return std::nullopt;
    if (!isLethal(to)) return 1.0;
    return map.states().at(to) == CellState::kOccupied ? kOccupied : kNarrow;
  };
  const std::optional<CellPath> path =
      cheapest(map.rect(), escape->back(), price, [&](CellIndex cell) { return cell == goal; });
  if (!path) return std::nullopt;
  const auto lethal = std::find_if(path->begin(), path->end(), isLethal);
  if (lethal == path->end()) return std::nullopt;
  const auto roomy = std::find_if(std::make_reverse_iterator(lethal), path->rend(),
                                  [&](CellIndex cell) { return hasRoomToStop(map, cell); });
  return BlockedPath{roomy == path->rend() ? *std::prev(lethal) : *roomy, *lethal};
}

}  // namespace swiftlet::planning
