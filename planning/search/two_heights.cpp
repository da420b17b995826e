#include "planning/search/two_heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "common/check.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/edge_cost.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;

/// A cell at one of the two heights.
struct Place {
  CellIndex cell;
  bool lower = false;
};

constexpr std::int32_t kNotReached = std::numeric_limits<std::int32_t>::max();

/// Dijkstra over the cells of both maps. The nodes of the lower one follow those of the upper one.
class HeightSearch {
 public:
  HeightSearch(const TwoHeights& maps, double change_cost_m)
      : maps_(maps),
        cells_(static_cast<int>(maps.upper.costs().size())),
        change_(
            static_cast<std::int32_t>(std::lround(change_cost_m / maps.upper.resolution_m() * CostMap::kStraightMin))) {
  }

  /// From one place to another, both included; empty if there is no path.
  std::vector<Place> path(const Place& from, const Place& to) {
    cost_.assign(2 * static_cast<std::size_t>(cells_), kNotReached);
    from_.assign(cost_.size(), -1);
    const int first = nodeOf(from), last = nodeOf(to);
    improve(first, 0, -1);
    while (!open_.empty()) {
      const auto [cost, node] = open_.top();
      open_.pop();
      if (cost > cost_[static_cast<std::size_t>(node)]) continue;
      if (node == last) break;
      expand(node, cost);
    }
    std::vector<Place> places;
    if (cost_[static_cast<std::size_t>(last)] == kNotReached) return places;
    for (int node = last; node >= 0; node = from_[static_cast<std::size_t>(node)]) places.push_back(placeOf(node));
    std::reverse(places.begin(), places.end());
    return places;
  }

 private:
  int nodeOf(const Place& place) const { return maps_.upper.indexOf(place.cell) + (place.lower ? cells_ : 0); }
  Place placeOf(int node) const { return {maps_.upper.cellOf(node % cells_), node >= cells_}; }

  void improve(int node, std::int32_t cost, int from) {
    if (cost >= cost_[static_cast<std::size_t>(node)]) return;
    cost_[static_cast<std::size_t>(node)] = cost;
    from_[static_cast<std::size_t>(node)] = from;
    open_.push({cost, node});
  }

  void expand(int node, std::int32_t cost) {
    const bool lower = node >= cells_;
    const CostMap& map = lower ? maps_.lower : maps_.upper;
    const int cell = node % cells_, layer = node - cell;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::int32_t edge = edgeCost(map, cell, dx, dy);
        if (edge == kNoEdge) continue;
        improve(layer + cell + dy * map.rect().width() + dx, cost + edge + (lower ? edge / 2 : 0), node);
      }
    if (!maps_.upper.isLethal(cell) && !maps_.lower.isLethal(cell))
      improve(lower ? cell : cell + cells_, cost + change_, node);
  }

  const TwoHeights& maps_;
  int cells_;
  std::int32_t change_;
  std::vector<std::int32_t> cost_;
  std::vector<int> from_;
  using Entry = std::pair<std::int32_t, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

/// The places as lines, without cells that a straight line cuts short. `escape` cells of the first stretch are those of
/// the escape.
Path linesThrough(const TwoHeights& maps, const std::vector<Place>& places, std::size_t escape,
                  const Eigen::Vector2d& start_map_m, const Eigen::Vector2d& goal_map_m, double change_cost_m) {
  Path path;
  for (std::size_t begin = 0; begin < places.size();) {
    std::size_t end = begin;
    CellPath cells;
    while (end < places.size() && places[end].lower == places[begin].lower) cells.push_back(places[end++].cell);
    const CostMap& map = places[begin].lower ? maps.lower : maps.upper;
    const Eigen::Vector2d from_m = begin == 0 ? start_map_m : path.points_map_m.back();
    const Eigen::Vector2d to_m = end == places.size() ? goal_map_m : map.centerOf(cells.back());
    Path stretch = shortened(map, cells, begin == 0 ? escape : 0, from_m, to_m);
    if (begin == 0) path.escape_points = stretch.escape_points;
    const auto& points = stretch.points_map_m;
    path.points_map_m.insert(path.points_map_m.end(), points.begin() + (begin == 0 ? 0 : 1), points.end());
    path.lowered.resize(path.points_map_m.size() - 1, places[begin].lower);
    path.length_m += stretch.length_m;
    path.cost_m += (begin == 0 ? 0.0 : change_cost_m) + stretch.cost_m;
    begin = end;
  }
  path.lower_height_m = maps.lower_height_m;
  return path;
}

}  // namespace

tl::expected<Path, PlanFailure> planAtTwoHeights(const TwoHeights& maps, const Eigen::Vector2d& start_map_m,
                                                 const Eigen::Vector2d& goal_map_m, bool starts_lower,
                                                 double change_cost_m) {
  SWIFTLET_CHECK(maps.upper.rect() == maps.lower.rect(), maps.upper.costs().size(), maps.lower.costs().size());
  const CostMap& first = starts_lower ? maps.lower : maps.upper;
  const CellIndex goal = maps.upper.cellAt(goal_map_m);
  const bool ends_lower = maps.upper.costAt(goal) == CostMap::kLethal;
  if (ends_lower && maps.lower.costAt(goal) == CostMap::kLethal) {
    // The refusal at the height of flight explains more: there the laser has seen the map.
    auto refused = admit(maps.upper, start_map_m, goal_map_m);
    return tl::make_unexpected(refused ? unreachable(maps.upper, goal_map_m) : refused.error());
  }
  const std::optional<CellPath> escape = escapeFrom(first, first.cellAt(start_map_m));
  if (!escape) return tl::make_unexpected(unreachable(maps.upper, goal_map_m));

  const std::vector<Place> path =
      HeightSearch(maps, change_cost_m).path({escape->back(), starts_lower}, {goal, ends_lower});
  if (path.empty()) return tl::make_unexpected(unreachable(maps.upper, goal_map_m));
  std::vector<Place> places;
  for (const CellIndex cell : *escape) places.push_back({cell, starts_lower});
  places.insert(places.end(), path.begin() + 1, path.end());
  return linesThrough(maps, places, escape->size() - 1, start_map_m, goal_map_m, change_cost_m);
}

}  // namespace swiftlet::planning
