// Traversal of the grid cells that a ray crosses.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"

namespace swiftlet::perception {

/// The cell that contains a point given in cells, with fractions.
inline common::CellIndex cellOf(const Eigen::Vector2d& point_cells) {
  return {static_cast<int>(std::floor(point_cells.x())), static_cast<int>(std::floor(point_cells.y()))};
}

/// Calls visit(cell, enters, leaves) for each cell that the line from `from` to `to` touches, in order, but not for the
/// cell of `to` (Amanatides and Woo 1987). Stops when visit returns false. Returns true if it never did.
/// Both points are in cells, with fractions. `enters` and `leaves` are the fractions of the line's length at which it
/// enters and leaves the cell.
/// A simpler traversal that rasterizes the line by cell centres would leave unvisited cells between neighbouring rays,
/// and each of these would become a frontier.
template <typename Visit>
bool visitCrossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Visit&& visit) {
  const common::CellIndex begin = cellOf(from), end = cellOf(to);
  const Eigen::Vector2d ray = to - from;
  int left_x = std::abs(end.x - begin.x), left_y = std::abs(end.y - begin.y);
  const double per_x = 1.0 / std::max(std::abs(ray.x()), 1e-12), per_y = 1.0 / std::max(std::abs(ray.y()), 1e-12);
  double next_x = per_x * (ray.x() >= 0.0 ? begin.x + 1 - from.x() : from.x() - begin.x);
  double next_y = per_y * (ray.y() >= 0.0 ? begin.y + 1 - from.y() : from.y() - begin.y);
  const int step_x = ray.x() >= 0.0 ? 1 : -1, step_y = ray.y() >= 0.0 ? 1 : -1;
  common::CellIndex cell = begin;
  double enters = 0.0;
  while (left_x + left_y > 0) {
    const bool along_x = left_y == 0 || (left_x > 0 && next_x < next_y);
    const double leaves = along_x ? next_x : next_y;
    if (!visit(cell, enters, leaves)) return false;
    enters = leaves;
    if (along_x) {
      cell.x += step_x;
      next_x += per_x;
      --left_x;
    } else {
      cell.y += step_y;
      next_y += per_y;
      --left_y;
    }
  }
  return true;
}

/// The farthest visible point of the line from `from` to `to` when cells with isWall(cell) block the view. It is `to`,
/// or a point inside the last cell before the first wall. All points are in cells, with fractions.
template <typename IsWall>
Eigen::Vector2d beforeWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, IsWall&& isWall) {
  // The result must not lie in a cell that the line touches only at a corner: rounding could move it to the next cell.
  constexpr double kCorner = 1e-6;
  double reached = 0.0;
  const bool open = visitCrossed(from, to, [&](const common::CellIndex& cell, double enters, double leaves) {
    if (isWall(cell)) return false;
    if (leaves - enters > kCorner) reached = 0.5 * (enters + leaves);
    return true;
  });
  return open && !isWall(cellOf(to)) ? to : from + reached * (to - from);
}

}  // namespace swiftlet::perception
