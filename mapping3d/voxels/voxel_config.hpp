// How depth images and laser beams change the occupancy of voxels.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::mapping3d {

/// The sensor model is that of Hornung et al. 2013, "OctoMap", section 3.2: log odds, clamped. All log odds are rounded
/// to steps of common::VoxelMap::kLogOddsStep.
struct VoxelConfig {
  double resolution_m = 0.05;
  double range_max_m = 5.0;      ///< Farther surfaces are not drawn; the ray is free up to here. At most 500 voxels.
  double least_log_odds = -2.0;  ///< Log odds of a voxel are not below this.
  int blocks_max = 200'000;  ///< Blocks of 8 x 8 x 8 voxels that the map holds; beyond, those farthest from the sensor
                             ///< are forgotten.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

}  // namespace swiftlet::mapping3d
