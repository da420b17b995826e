// From a chain of cells to a path: costs of segments, and shortcuts that never raise the risk.
#include <algorithm>
#include <cmath>
#include <limits>

#include "planning/search/planner.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Point = Eigen::Vector2d;

/// The polyline through the cells, with the cost up to each vertex. Its ends are the exact start and goal.
struct Chain {
  std::vector<Point> points_m;
  std::vector<double> cost_m;            ///< From the first vertex to this one.
  std::vector<CostMap::Cost> cell_cost;  ///< Greatest cell cost on the segment that ends here.
};

Chain chainOf(const CostMap& map, std::vector<Point> points_m) {
  Chain chain{std::move(points_m), {0.0}, {0}};
  for (std::size_t i = 1; i < chain.points_m.size(); ++i) {
    const SegmentCost step = segmentCost(map, chain.points_m[i - 1], chain.points_m[i]);
    chain.cost_m.push_back(chain.cost_m.back() + step.cost_m);
    chain.cell_cost.push_back(step.greatest);
  }
  return chain;
}

bool mayShortcut(const CostMap& map, const Chain& chain, std::size_t from, std::size_t to) {
  constexpr double kRounding_m = 1e-9;
  const SegmentCost direct = segmentCost(map, chain.points_m[from], chain.points_m[to]);
  if (direct.lethal || direct.cost_m > chain.cost_m[to] - chain.cost_m[from] + kRounding_m) return false;
  const auto begin = chain.cell_cost.begin();
  return direct.greatest <=
         *std::max_element(begin + static_cast<std::ptrdiff_t>(from) + 1, begin + static_cast<std::ptrdiff_t>(to) + 1);
}

/// The farthest vertex found, by doubling and bisection, to which there is a straight shortcut from `from`.
std::size_t farthest(const CostMap& map, const Chain& chain, std::size_t from) {
  const std::size_t last = chain.points_m.size() - 1;
  std::size_t good = from + 1, bad = last + 1;
  for (std::size_t step = 2; good < last; step *= 2) {
    const std::size_t to = std::min(from + step, last);
    if (!mayShortcut(map, chain, from, to)) {
      bad = to;
      break;
    }
    good = to;
  }
  while (good + 1 < bad) {
    const std::size_t middle = (good + bad) / 2;
    (mayShortcut(map, chain, from, middle) ? good : bad) = middle;
  }
  return good;
}

std::vector<Point> pulled(const CostMap& map, const std::vector<Point>& points_m) {
  const Chain chain = chainOf(map, points_m);
  std::vector<Point> result{points_m.front()};
  for (std::size_t at = 0; at + 1 < points_m.size();) {
    at = farthest(map, chain, at);
    result.push_back(points_m[at]);
  }
  return result;
}

}  // namespace

SegmentCost segmentCost(const CostMap& map, const Point& from_map_m, const Point& to_map_m) {
  // Amanatides and Woo 1987: t runs from 0 to 1; `next` is the t at which the segment crosses the next border in x and
  // in y.
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kCorner = 1e-9;
  const Point step_m = to_map_m - from_map_m;
  const double length_m = step_m.norm(), resolution_m = map.resolution_m();
  CellIndex cell = map.cellAt(from_map_m);
  const CellIndex last = map.cellAt(to_map_m);
  const int sign_x = step_m.x() > 0 ? 1 : -1, sign_y = step_m.y() > 0 ? 1 : -1;
  const auto crossing = [&](double from, double step, int index, int sign) {
    return step == 0.0 ? kInfinity : ((index + (sign > 0)) * resolution_m - from) / step;
  };
  const Point delta{step_m.x() == 0.0 ? kInfinity : resolution_m / std::abs(step_m.x()),
                    step_m.y() == 0.0 ? kInfinity : resolution_m / std::abs(step_m.y())};
  Point next{crossing(from_map_m.x(), step_m.x(), cell.x, sign_x),
             crossing(from_map_m.y(), step_m.y(), cell.y, sign_y)};

  SegmentCost result;
  double t = 0.0;
  const auto visit = [&](CellIndex c, double share) {
    const CostMap::Cost cost = map.costAt(c);
    result.greatest = std::max(result.greatest, cost);
    result.lethal |= cost == CostMap::kLethal;
    result.cost_m += share * length_m * cost / CostMap::kOpenCost;
  };
  while (cell != last) {
    if (cell.x == last.x) next.x() = kInfinity;
    if (cell.y == last.y) next.y() = kInfinity;
    const double t_next = std::min({next.x(), next.y(), 1.0});
    visit(cell, std::max(0.0, t_next - t));
    t = std::max(t, t_next);
    const bool over_x = next.x() <= next.y() + kCorner, over_y = next.y() <= next.x() + kCorner;
    if (over_x && over_y) {
      // The segment crosses a corner, so it also touches the cells beside it.
      visit({cell.x + sign_x, cell.y}, 0.0);
      visit({cell.x, cell.y + sign_y}, 0.0);
    }
    const CellIndex before = cell;
    if (over_x) {
      cell.x += sign_x;
      next.x() += delta.x();
    }
    if (over_y) {
      cell.y += sign_y;
      next.y() += delta.y();
    }
    if (map.rect().contains(before) && map.rect().contains(cell))
      result.cost_m +=
          map.steps().cost(map.indexOf(before), map.indexOf(cell)) * (resolution_m / CostMap::kStraightMin);
  }
  visit(last, std::max(0.0, 1.0 - t));
  return result;
}

Path pathThrough(const CostMap& map, std::vector<Point> points_map_m, std::size_t escape_points) {
  Path path{std::move(points_map_m), 0.0, 0.0, escape_points};
  for (std::size_t i = 1; i < path.points_map_m.size(); ++i) {
    const Point& a = path.points_map_m[i - 1];
    const Point& b = path.points_map_m[i];
    path.length_m += (b - a).norm();
    path.cost_m += i <= escape_points ? (b - a).norm() : segmentCost(map, a, b).cost_m;
  }
  return path;
}

Path shortened(const CostMap& map, const CellPath& cells, std::size_t escape_cells, const Point& start_map_m,
               const Point& goal_map_m) {
  std::vector<Point> points_m;
  points_m.reserve(cells.size() + 1);
  for (const CellIndex cell : cells) points_m.push_back(map.centerOf(cell));
  points_m.front() = start_map_m;
  if (points_m.size() == 1) {
    if (start_map_m != goal_map_m) points_m.push_back(goal_map_m);
  } else {
    points_m.back() = goal_map_m;
  }

  const std::size_t kept = std::min(escape_cells, points_m.size() - 1);
  std::vector<Point> path_m(points_m.begin(), points_m.begin() + static_cast<std::ptrdiff_t>(kept));
  points_m.erase(points_m.begin(), points_m.begin() + static_cast<std::ptrdiff_t>(kept));
  const std::vector<Point> rest = pulled(map, points_m);
  path_m.insert(path_m.end(), rest.begin(), rest.end());
  return pathThrough(map, std::move(path_m), kept);
}

}  // namespace swiftlet::planning
