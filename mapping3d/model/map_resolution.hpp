// How fine a 3D map is.
#pragma once

#include "mapping3d/model/mapper3d.hpp"

namespace swiftlet::mapping3d {

/// Makes voxels and the cubes of points that large; `resolution_m` is within the bounds of both settings. Voxels then
/// end where the noise of a depth is as large as they are.
void setResolution(double resolution_m, Mapper3dConfig& config);

}  // namespace swiftlet::mapping3d
