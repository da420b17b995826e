// All submaps as one map.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// The submaps' evidence in the frame `map`: each voxel has the sum of the submaps' log odds at its centre, limited to
/// log odds of 6, the greatest that a profile may set for one frame after the other. A pure function, made to be run as
/// a job: it takes time in proportion to the blocks of all submaps. The submaps must have the given resolution, which
/// the result has too, and their key scans must be in `scans`.
common::VoxelMap fuse(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& scans, double resolution_m);

}  // namespace swiftlet::mapping3d
