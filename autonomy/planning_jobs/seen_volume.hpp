// The volume that the camera has seen up to now, for explorers that look at all of it.
#pragma once

#include <memory>

#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// The fused map, which is made every 10 s, with what only the newest submaps know, at their present places. Null while
/// nothing was seen.
std::shared_ptr<const common::VoxelMap> seenVolume(const common::Map3dLayer& layer);

}  // namespace swiftlet::autonomy
