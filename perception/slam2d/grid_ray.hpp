// The cells a view passes through.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"

namespace swiftlet::perception {

/// The cell of a point that is given in cells, with fractions.
inline common::CellIndex cellOf(const Eigen::Vector2d& point_cells) {
  return {static_cast<int>(std::floor(point_cells.x())), static_cast<int>(std::floor(point_cells.y()))};
}

/// Calls touch(mark) for every cell the line from `from` to `to` touches, up to, but without, that of its end
/// (Amanatides and Woo 1987). Lines through cell centres only would leave pinholes between the rays, and each would be
/// a frontier. Both points are in cells, with fractions; `mark` is that of the cell of `from`, in rows of `stride`.
template <typename Mark, typename Touch>
void touchCrossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Mark* mark, int stride, Touch&& touch) {
  const common::CellIndex begin = cellOf(from), end = cellOf(to);
  const Eigen::Vector2d ray = to - from;
  int left_x = std::abs(end.x - begin.x), left_y = std::abs(end.y - begin.y);
  const double per_x = 1.0 / std::max(std::abs(ray.x()), 1e-12), per_y = 1.0 / std::max(std::abs(ray.y()), 1e-12);
  double next_x = per_x * (ray.x() >= 0.0 ? begin.x + 1 - from.x() : from.x() - begin.x);
  double next_y = per_y * (ray.y() >= 0.0 ? begin.y + 1 - from.y() : from.y() - begin.y);
  const std::ptrdiff_t step_x = ray.x() >= 0.0 ? 1 : -1;
  const std::ptrdiff_t step_y = ray.y() >= 0.0 ? stride : -static_cast<std::ptrdiff_t>(stride);
  while (left_x + left_y > 0) {
    touch(*mark);
    if (left_y == 0 || (left_x > 0 && next_x < next_y)) {
      mark += step_x;
      next_x += per_x;
      --left_x;
    } else {
      mark += step_y;
      next_y += per_y;
      --left_y;
    }
  }
}

}  // namespace swiftlet::perception
