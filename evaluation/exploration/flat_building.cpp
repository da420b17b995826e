#include "evaluation/exploration/flat_building.hpp"

#include <algorithm>
#include <cmath>

#include "planning/search/wavefront.hpp"

namespace swiftlet::evaluation {

using common::CellIndex;
using common::CellRect;

FlatBuilding::FlatBuilding(const common::OccupancyGrid& plan, double resolution_m) : resolution_m_(resolution_m) {
  const CellRect known = knownExtent(plan);
  if (known.empty()) return;
  const double scale = plan.resolution_m() / resolution_m;
  const auto down = [&](int cell) { return static_cast<int>(std::floor(cell * scale + 1e-9)); };
  const auto up = [&](int cell) { return static_cast<int>(std::ceil(cell * scale - 1e-9)); };
  // A ring of wall around, that the beams end at.
  rect_ = {{down(known.begin.x) - 1, down(known.begin.y) - 1}, {up(known.end.x) + 1, up(known.end.y) + 1}};
  wall_.assign(static_cast<std::size_t>(rect_.width()) * rect_.height(), 0);
  const int samples = std::max(1, static_cast<int>(std::ceil(1.0 / scale - 1e-9)));
  for (int y = rect_.begin.y; y < rect_.end.y; ++y)
    for (int x = rect_.begin.x; x < rect_.end.x; ++x)
      for (int i = 0; i < samples * samples; ++i) {
        const Eigen::Vector2d point_m =
            resolution_m * Eigen::Vector2d(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples);
        if (!common::occupancy::isFree(plan.at(plan.cellAt(point_m)))) wall_[indexOf({x, y})] = 1;
      }
}

CellIndex FlatBuilding::cellAt(const Eigen::Vector2d& point_m) const {
  return {static_cast<int>(std::floor(point_m.x() / resolution_m_)),
          static_cast<int>(std::floor(point_m.y() / resolution_m_))};
}

Eigen::Vector2d FlatBuilding::centerOf(CellIndex cell) const {
  return resolution_m_ * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
}

common::OccupancyGrid FlatBuilding::seen() const {
  common::OccupancyGrid grid = common::makeOccupancyGrid(resolution_m_);
  for (int y = rect_.begin.y; y < rect_.end.y; ++y)
    for (int x = rect_.begin.x; x < rect_.end.x; ++x)
      grid.set({x, y}, isWall({x, y}) ? common::occupancy::kMaxSteps : -common::occupancy::kMaxSteps);
  return grid;
}

std::optional<Eigen::Vector2d> startIn(const planning::CostMap& map, const Eigen::Vector2d& near_m) {
  std::vector<bool> known(map.costs().size(), false);
  std::vector<int> largest;
  planning::CostField field;
  for (int i = 0; i < static_cast<int>(map.costs().size()); ++i) {
    if (map.isLethal(i) || known[static_cast<std::size_t>(i)]) continue;
    field.spread(map, map.cellOf(i));
    std::vector<int> region;
    for (int j = i; j < static_cast<int>(map.costs().size()); ++j)
      if (field.reached(j)) {
        known[static_cast<std::size_t>(j)] = true;
        region.push_back(j);
      }
    if (region.size() > largest.size()) largest = std::move(region);
  }
  if (largest.empty()) return std::nullopt;
  const CellRect plan = knownExtent(map.states().grid());
  const Eigen::Vector2d low_m = map.centerOf(plan.begin), high_m = map.centerOf(plan.end);
  const bool inside = (near_m.array() > low_m.array()).all() && (near_m.array() < high_m.array()).all();
  const Eigen::Vector2d middle_m = inside ? near_m : Eigen::Vector2d(0.5 * (low_m + high_m));
  const auto farness = [&](int index) { return (map.centerOf(map.cellOf(index)) - middle_m).squaredNorm(); };
  const int best =
      *std::min_element(largest.begin(), largest.end(), [&](int a, int b) { return farness(a) < farness(b); });
  return map.centerOf(map.cellOf(best));
}

}  // namespace swiftlet::evaluation
