// The cells in which the ground is known.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"

namespace swiftlet::perception {

/// Side of a cell with a slope: smaller ones have too few points for a gradient, larger ones do not end where a ramp
/// does.
inline constexpr double kSlopeCell_m = 0.4;

/// The cell of that side in which a place is; the corners of cells are at multiples of the side.
inline common::CellIndex cellAt(const Eigen::Vector2d& place_m, double side_m) {
  return {static_cast<int>(std::floor(place_m.x() / side_m)), static_cast<int>(std::floor(place_m.y() / side_m))};
}

}  // namespace swiftlet::perception
