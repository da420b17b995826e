// A building in the plane, as a floor plan shows it, to compare explorers in: dense cells, an ideal laser, and what a
// hull can reach. Its frame is the plan's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::evaluation {

/// What is not known to be free is wall, and all outside of the plan. A value.
class FlatBuilding {
 public:
  /// A cell of `resolution_m` is wall where any cell of the plan in it is.
  FlatBuilding(const common::OccupancyGrid& plan, double resolution_m);

  double resolution_m() const { return resolution_m_; }
  const common::CellRect& rect() const { return rect_; }
  common::CellIndex cellAt(const Eigen::Vector2d& point_m) const;
  Eigen::Vector2d centerOf(common::CellIndex cell) const;
  bool isWall(common::CellIndex cell) const { return !rect_.contains(cell) || wall_[indexOf(cell)] != 0; }
  /// Of a cell inside, row by row.
  std::size_t indexOf(common::CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - rect_.begin.y) * rect_.width() + (cell.x - rect_.begin.x);
  }

  /// The whole building as a map, everything in it seen.
  common::OccupancyGrid seen() const;

  /// Calls visit(cell, is_wall) for the cells that a beam meets, the wall at its end last; `range_m` beyond it is
  /// nothing. The cell of the laser is not met (Amanatides and Woo 1987).
  template <typename Visit>
  void cast(const Eigen::Vector2d& from_m, double angle_rad, double range_m, Visit&& visit) const;

 private:
  double resolution_m_;
  common::CellRect rect_;
  std::vector<std::uint8_t> wall_;
};

/// Where in a building to begin: of the largest region that a hull can fly in, the place nearest to `near_m`, or to the
/// middle of the map if that is outside of it. nullopt if the hull fits nowhere.
std::optional<Eigen::Vector2d> startIn(const planning::CostMap& building_map, const Eigen::Vector2d& near_m);

template <typename Visit>
void FlatBuilding::cast(const Eigen::Vector2d& from_m, double angle_rad, double range_m, Visit&& visit) const {
  const double dx = std::cos(angle_rad), dy = std::sin(angle_rad);
  common::CellIndex cell = cellAt(from_m);
  const int step_x = dx > 0.0 ? 1 : -1, step_y = dy > 0.0 ? 1 : -1;
  const auto delta = [&](double d) { return std::abs(d) < 1e-12 ? 1e12 : resolution_m_ / std::abs(d); };
  const auto first = [&](double at_m, double d, int index) {
    return std::abs(d) < 1e-12 ? 1e12 : ((index + (d > 0.0 ? 1 : 0)) * resolution_m_ - at_m) / d;
  };
  const double delta_x_m = delta(dx), delta_y_m = delta(dy);
  double next_x_m = first(from_m.x(), dx, cell.x), next_y_m = first(from_m.y(), dy, cell.y);
  while (true) {
    const double at_m = std::min(next_x_m, next_y_m);
    if (at_m > range_m) return;
    if (next_x_m < next_y_m) {
      cell.x += step_x;
      next_x_m += delta_x_m;
    } else {
      cell.y += step_y;
      next_y_m += delta_y_m;
    }
    if (!rect_.contains(cell)) return;
    const bool is_wall = wall_[indexOf(cell)] != 0;
    visit(cell, is_wall);
    if (is_wall) return;
  }
}

}  // namespace swiftlet::evaluation
