// The surface of free space as few rectangles: what rays and a hull can meet that come from inside.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "mapping3d/voxels/free_space.hpp"

namespace swiftlet::mapping3d {

/// Corners counter-clockwise as seen from the free side.
using Quad = std::array<Eigen::Vector3f, 4>;

/// The faces between free voxels and all others, also those beyond the box, so that the surface is closed. Equal runs
/// of faces in adjacent rows are one rectangle. Ends early once there are more than `most` of them.
std::vector<Quad> surfaceOf(const FreeSpace& space, std::size_t most);

}  // namespace swiftlet::mapping3d
