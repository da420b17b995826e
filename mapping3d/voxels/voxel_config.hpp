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
  double range_max_m = 5.0;
  double hit_log_odds = 0.85;
  double miss_log_odds = -0.4;
  double least_log_odds = -2.0;
  double greatest_log_odds = 3.5;
  int blocks_max = 200'000;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::mapping3d
