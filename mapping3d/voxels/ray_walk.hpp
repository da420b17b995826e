// The voxels that a segment crosses, in order (Amanatides and Woo 1987).
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// Walks a segment from cell to cell of a grid whose cells have the side 1. When a boundary is crossed is computed from
/// its number alone, not summed up, so that errors do not grow along a ray. Boundaries that are crossed at the same
/// time are crossed in the order x, y, z.
class RayWalk {
 public:
  RayWalk(const Eigen::Vector3d& from, const Eigen::Vector3d& to) : from_(from) {
    for (int axis = 0; axis < 3; ++axis) {
      const double length = to[axis] - from[axis];
      cell_[axis] = static_cast<int>(std::floor(from[axis]));
      const int last = static_cast<int>(std::floor(to[axis]));
      step_[axis] = length > 0 ? 1 : -1;
      per_length_[axis] = length != 0.0 ? 1.0 / length : 0.0;
      left_[axis] = std::abs(last - cell_[axis]);
      next_[axis] = crossing(axis, cell_[axis]);
    }
  }

  common::VoxelIndex cell() const { return {cell_[0], cell_[1], cell_[2]}; }
  bool atEnd() const { return left_[0] + left_[1] + left_[2] == 0; }

  /// To the next cell; not beyond the last.
  void advance() {
    const int axis = next_[0] <= next_[1] ? (next_[0] <= next_[2] ? 0 : 2) : (next_[1] <= next_[2] ? 1 : 2);
    cell_[axis] += step_[axis];
    --left_[axis];
    next_[axis] = crossing(axis, cell_[axis]);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// When the segment leaves the cell along the axis; the segment goes from time 0 to time 1.
  double crossing(int axis, int cell) const {
    if (left_[axis] == 0) return kNever;
    return (cell + (step_[axis] > 0 ? 1 : 0) - from_[axis]) * per_length_[axis];
  }

  Eigen::Vector3d from_;
  std::array<int, 3> cell_{}, step_{}, left_{};
  std::array<double, 3> per_length_{}, next_{};
};

}  // namespace swiftlet::mapping3d
