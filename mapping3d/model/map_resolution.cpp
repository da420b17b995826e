#include "mapping3d/model/map_resolution.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::mapping3d {

void setResolution(double resolution_m, Mapper3dConfig& config) {
  config.voxels.resolution_m = config.submaps.cube_m = resolution_m;
  const double resolved_m = std::sqrt(resolution_m / config.odometry.features.depth_noise.sigma_per_m2);
  config.voxels.range_max_m = std::min(config.voxels.range_max_m, resolved_m);
}

}  // namespace swiftlet::mapping3d
