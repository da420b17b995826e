#include "simulation/truth_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <queue>
#include <utility>

namespace swiftlet::simulation {
namespace {

using common::CellIndex;
using Grid = common::TiledGrid<std::uint8_t>;

Hull bandHull(const FreeSpaceQuery& query) { return {query.hull_radius_m, 0.5 * (query.top_m - query.bottom_m)}; }
double bandMiddle_m(const FreeSpaceQuery& query) { return 0.5 * (query.bottom_m + query.top_m); }

/// Neighbours are joined only if the hull can pass from one to the other, so that the flood does not leak through thin
/// walls. A door is looked at from the end alone, since the hull is wider than a step.
bool passes(const RayCaster& rays, const FreeSpaceQuery& query, const Eigen::Vector2d& from,
            const Eigen::Vector2d& to) {
  const Hull hull = bandHull(query);
  const Eigen::Vector3d begin(from.x(), from.y(), bandMiddle_m(query)), end(to.x(), to.y(), bandMiddle_m(query));
  return rays.sweep(hull, begin, end, 1e-6).shape == Hit::kNothing &&
         std::all_of(query.closed_doors.begin(), query.closed_doors.end(),
                     [&](const Actor& door) { return gapTo_m(door, hull, end) > 0.0; });
}

bool fits(const RayCaster& rays, const FreeSpaceQuery& query, const Eigen::Vector2d& point) {
  return passes(rays, query, point, point);
}

std::size_t count(const Grid& grid) {
  std::size_t cells = 0;
  grid.forEachCell([&cells](CellIndex, std::uint8_t cell) { cells += cell; });
  return cells;
}

Grid dilated(const Grid& grid, double radius_m) {
  const double resolution_m = grid.resolution_m();
  const int reach = static_cast<int>(std::ceil(radius_m / resolution_m));
  Grid covered(resolution_m);
  grid.forEachCell([&](CellIndex c, std::uint8_t cell) {
    if (cell == 0) return;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (std::hypot(dx, dy) * resolution_m <= radius_m) covered.set({c.x + dx, c.y + dy}, 1);
  });
  return covered;
}

}  // namespace

common::TiledGrid<std::uint8_t> reachableSpace(const RayCaster& rays, const FreeSpaceQuery& query) {
  Grid reachable(query.resolution_m);
  const CellIndex start = reachable.cellAt(query.start_world_m);
  if (!fits(rays, query, query.start_world_m)) return reachable;
  reachable.set(start, 1);
  std::deque<CellIndex> open{start};
  const double cell_m2 = query.resolution_m * query.resolution_m;
  double area_m2 = cell_m2;
  while (!open.empty() && area_m2 < query.max_area_m2) {
    const CellIndex from = open.front();
    open.pop_front();
    const Eigen::Vector2d at = from == start ? query.start_world_m : reachable.centerOf(from);
    for (const CellIndex next : std::array<CellIndex, 4>{
             {{from.x + 1, from.y}, {from.x - 1, from.y}, {from.x, from.y + 1}, {from.x, from.y - 1}}}) {
      if (reachable.at(next) != 0 || !passes(rays, query, at, reachable.centerOf(next))) continue;
      reachable.set(next, 1);
      area_m2 += cell_m2;
      open.push_back(next);
    }
  }
  return reachable;
}

double area_m2(const Grid& cells) {
  return cells.resolution_m() * cells.resolution_m() * static_cast<double>(count(cells));
}

std::optional<double> pathLength_m(const Grid& cells, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  using Entry = std::pair<double, std::pair<int, int>>;
  const CellIndex goal = cells.cellAt(to_m), start = cells.cellAt(from_m);
  Grid done(cells.resolution_m());
  std::map<std::pair<int, int>, double> best{{{start.x, start.y}, 0.0}};
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  if (cells.at(start) != 0) open.push({0.0, {start.x, start.y}});
  while (!open.empty()) {
    const auto [length_m, at] = open.top();
    open.pop();
    if (at.first == goal.x && at.second == goal.y) return length_m;
    if (done.at({at.first, at.second}) != 0) continue;
    done.set({at.first, at.second}, 1);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{at.first + dx, at.second + dy};
        if ((dx == 0 && dy == 0) || cells.at(next) == 0 || done.at(next) != 0) continue;
        const double next_m = length_m + cells.resolution_m() * std::hypot(dx, dy);
        const auto [known, is_new] = best.try_emplace({next.x, next.y}, next_m);
        if (!is_new && known->second <= next_m) continue;
        known->second = next_m;
        open.push({next_m, {next.x, next.y}});
      }
  }
  return std::nullopt;
}

FreeSpace freeSpace(const RayCaster& rays, const FreeSpaceQuery& query) {
  FreeSpace space{reachableSpace(rays, query), Grid(query.resolution_m)};
  space.reachable_area_m2 = area_m2(space.reachable);
  if (space.isOpen(query)) return space;
  space.covered = dilated(space.reachable, query.hull_radius_m);
  space.covered_area_m2 = area_m2(space.covered);
  return space;
}

double distanceToSurface2d(const RayCaster& rays, const Eigen::Vector2d& point_world_m, double height_world_m,
                           double limit_m) {
  const Eigen::Vector3d point(point_world_m.x(), point_world_m.y(), height_world_m);
  return rays.sweep({0.0, 1e-3}, point, point, limit_m).distance_m;
}

}  // namespace swiftlet::simulation
