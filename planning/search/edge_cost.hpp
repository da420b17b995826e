// The costs of the edges between the cells of a cost map, by which all planners search.
#pragma once

#include <cstdint>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

inline constexpr std::int32_t kNoEdge = INT32_MAX;

/// The cost of moving between two 8-neighbours, the first of them not lethal. kNoEdge to a lethal cell, and for a
/// diagonal if one of the two cells beside it is lethal, so that no corner is cut.
inline std::int32_t edgeCost(const CostMap& map, int from, int dx, int dy) {
  const int row = dy * map.rect().width(), to = from + row + dx;
  const bool diagonal = dx != 0 && dy != 0;
  if (map.isLethal(to) || (diagonal && (map.isLethal(from + dx) || map.isLethal(from + row)))) return kNoEdge;
  const int cells = map.costs()[static_cast<std::size_t>(from)] + map.costs()[static_cast<std::size_t>(to)];
  return (diagonal ? CostMap::kDiagonalEdge : CostMap::kStraightEdge) * cells + map.steps().cost(from, to);
}

/// No edge of the map costs more.
inline std::int32_t greatestEdgeCost(const CostMap& map) {
  return 2 * CostMap::kDiagonalEdge * map.greatestCost() + map.steps().greatestCost();
}

}  // namespace swiftlet::planning
