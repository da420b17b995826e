// Ways through what the planners must not cross: out of the lethal zone, and as far as it is free towards a goal behind
// something. One Dijkstra over prices that keep off what cannot be crossed as long as there is another way.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "planning/search/planner.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;

/// The cheapest chain within the window from the start to the first cell that is an end. `price` is that of a straight
/// step from a cell to its neighbour; none: it may not be taken.
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

}  // namespace

std::optional<CellPath> escapeFrom(const CostMap& map, CellIndex start, double reach_m) {
  constexpr double kNearness = 4.0, kUnknown = 20.0, kOccupied = 50.0;
  if (!map.contains(start)) return std::nullopt;
  const int reach = static_cast<int>(std::ceil(reach_m / map.resolution_m()));
  const auto price = [&](CellIndex, CellIndex cell) -> std::optional<double> {
    const double from_start_m = std::hypot(cell.x - start.x, cell.y - start.y) * map.resolution_m();
    if (!map.contains(cell) || from_start_m > reach_m) return std::nullopt;
    switch (map.stateAt(cell)) {
      case CellState::kFree:
        return 1.0 + kNearness * std::max(0.0, 1.0 - map.obstacleDistance_m(cell) / map.footprint().radius_m());
      case CellState::kUnknown:
        return kUnknown;
      case CellState::kOccupied:
        // Where the hull is, nothing else can be: the map is wrong there.
        if (from_start_m <= map.footprint().hull_radius_m) return kOccupied;
    }
    return std::nullopt;
  };
  return cheapest({{start.x - reach, start.y - reach}, {start.x + reach + 1, start.y + reach + 1}}, start, price,
                  [&](CellIndex cell) { return map.costAt(cell) != CostMap::kLethal; });
}

std::optional<BlockedWay> blockedWay(const CostMap& map, CellIndex start, CellIndex goal) {
  // Who squeezes past something, or waits for it to go, is nearer than who flies through a wall.
  constexpr double kNarrow = 4.0, kOccupied = 200.0;
  const std::optional<CellPath> escape = escapeFrom(map, start);
  if (!escape || !map.contains(goal)) return std::nullopt;
  const auto isLethal = [&](CellIndex cell) { return map.costAt(cell) == CostMap::kLethal; };
  const auto price = [&](CellIndex from, CellIndex to) -> std::optional<double> {
    if (map.stateAt(to) == CellState::kUnknown) return std::nullopt;
    const bool diagonal = from.x != to.x && from.y != to.y;  // The planners cut no corner either.
    if (diagonal && (isLethal({from.x, to.y}) || isLethal({to.x, from.y}))) return std::nullopt;
    if (!isLethal(to)) return 1.0;
    return map.stateAt(to) == CellState::kOccupied ? kOccupied : kNarrow;
  };
  const std::optional<CellPath> way =
      cheapest(map.rect(), escape->back(), price, [&](CellIndex cell) { return cell == goal; });
  if (!way) return std::nullopt;
  const auto lethal = std::find_if(way->begin(), way->end(), isLethal);
  if (lethal == way->end()) return std::nullopt;
  return BlockedWay{*std::prev(lethal), *lethal};
}

}  // namespace swiftlet::planning
