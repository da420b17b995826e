#include "planning/exploration/frontiers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swiftlet::planning {
namespace {

using common::CellIndex;

std::array<int, 4> fourNeighbours(const CostMap& map) { return {1, -1, map.rect().width(), -map.rect().width()}; }

bool touchesUnknown(const CostMap& map, int index) {
  for (const int step : fourNeighbours(map))
    if (map.states()[index + step] == CellState::kUnknown) return true;
  return false;
}

std::vector<CellIndex> flood(const CostMap& map, int seed, std::vector<bool>& waiting) {
  std::vector<CellIndex> cells;
  std::vector<int> open{seed};
  waiting[static_cast<std::size_t>(seed)] = false;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    cells.push_back(map.cellOf(at));
    for (const int row : {at - map.rect().width(), at, at + map.rect().width()}) {
      for (int next = row - 1; next <= row + 1; ++next) {
        if (!waiting[static_cast<std::size_t>(next)]) continue;
        waiting[static_cast<std::size_t>(next)] = false;
        open.push_back(next);
      }
    }
  }
  return cells;
}

/// Sorts the cells along their principal axis and returns their extent along it, in cells.
double sortAlongAxis(std::vector<CellIndex>& cells) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (const CellIndex c : cells) {
    mean_x += c.x;
    mean_y += c.y;
  }
  mean_x /= static_cast<double>(cells.size());
  mean_y /= static_cast<double>(cells.size());
  for (const CellIndex c : cells) {
    xx += (c.x - mean_x) * (c.x - mean_x);
    xy += (c.x - mean_x) * (c.y - mean_y);
    yy += (c.y - mean_y) * (c.y - mean_y);
  }
  const double axis_rad = 0.5 * std::atan2(2.0 * xy, xx - yy), axis_x = std::cos(axis_rad), axis_y = std::sin(axis_rad);
  const auto along = [&](CellIndex c) { return c.x * axis_x + c.y * axis_y; };
  std::sort(cells.begin(), cells.end(), [&](CellIndex a, CellIndex b) {
    const double p = along(a), q = along(b);
    return p != q ? p < q : a < b;
  });
  return along(cells.back()) - along(cells.front());
}

void cut(std::vector<CellIndex> cells, double run_length_m, double segment_cells, std::vector<FrontierRun>& runs) {
  const double extent = sortAlongAxis(cells);
  if (extent <= segment_cells || cells.size() < 2) {
    runs.push_back({std::move(cells), run_length_m});
    return;
  }
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  cut({cells.begin(), middle}, run_length_m, segment_cells, runs);
  cut({middle, cells.end()}, run_length_m, segment_cells, runs);
}

}  // namespace

std::vector<FrontierRun> findFrontiers(const CostMap& map, double segment_m) {
  std::vector<bool> waiting(map.costs().size(), false);
  std::vector<int> seeds;
  // No free cell lies on the outermost ring, because the map has a margin of unknown cells.
  for (int index = 0; index < static_cast<int>(map.costs().size()); ++index) {
    if (map.states()[index] != CellState::kFree || !touchesUnknown(map, index)) continue;
    waiting[static_cast<std::size_t>(index)] = true;
    seeds.push_back(index);
  }
  std::vector<FrontierRun> runs;
  for (const int seed : seeds) {
    if (!waiting[static_cast<std::size_t>(seed)]) continue;
    std::vector<CellIndex> cells = flood(map, seed, waiting);
    const double length_m = static_cast<double>(cells.size()) * map.resolution_m();
    cut(std::move(cells), length_m, segment_m / map.resolution_m(), runs);
  }
  return runs;
}

CellIndex unknownBeside(const CostMap& map, CellIndex frontier_cell) {
  const int index = map.indexOf(frontier_cell);
  for (const int step : fourNeighbours(map))
    if (map.states()[index + step] == CellState::kUnknown) return map.cellOf(index + step);
  return frontier_cell;
}

}  // namespace swiftlet::planning
