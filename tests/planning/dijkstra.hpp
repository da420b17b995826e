// The slow obvious planner that the fast ones must equal.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning::test {

inline constexpr std::int64_t kNever = INT64_MAX;

/// Cost from `source` to every cell, by the rules stated in the planners' headers. It shares no code with the planners.
inline std::vector<std::int64_t> dijkstra(const CostMap& map, int source) {
  std::vector<std::int64_t> cost(map.costs().size(), kNever);
  using Entry = std::pair<std::int64_t, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[static_cast<std::size_t>(source)] = 0;
  open.push({0, source});
  while (!open.empty()) {
    const auto [reached, at] = open.top();
    open.pop();
    if (reached > cost[static_cast<std::size_t>(at)]) continue;
    const common::CellIndex cell = map.cellOf(at);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const common::CellIndex next{cell.x + dx, cell.y + dy};
        const auto lethal = [&](common::CellIndex c) { return map.costAt(c) == CostMap::kLethal; };
        if (lethal(next) || lethal({cell.x + dx, cell.y}) || lethal({cell.x, cell.y + dy})) continue;
        const int i = map.indexOf(next);
        std::int64_t edge = (dx != 0 && dy != 0 ? 17L : 12L) * (map.costAt(cell) + map.costAt(next));
        if (const std::vector<std::int16_t>& heights_cm = map.steps().heights_cm; !heights_cm.empty())
          edge += std::int64_t{map.steps().cost_per_cm} *
                  std::abs(heights_cm[static_cast<std::size_t>(at)] - heights_cm[static_cast<std::size_t>(i)]);
        if (reached + edge >= cost[static_cast<std::size_t>(i)]) continue;
        cost[static_cast<std::size_t>(i)] = reached + edge;
        open.push({reached + edge, i});
      }
    }
  }
  return cost;
}

}  // namespace swiftlet::planning::test
