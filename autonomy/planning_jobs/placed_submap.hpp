// A submap of the 3D map at its place in the map, and whether it shows that something has gone which an earlier one
// has.
//
// A submap is drawn into while the sensor is near its origin. A person who stood in a door at that time would
// remain an obstacle there for the rest of the flight, because the vehicle comes back over other key scans and draws
// into another submap.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// Submaps are level, so their place is one in the plane.
struct PlacedSubmap {
  std::shared_ptr<const common::VoxelMap> voxels;
  common::Pose2 T_submap_map;
  std::uint64_t first_frame = 0, last_frame = 0;  ///< As in common::Submap3d.

  /// Whether all of it was seen after the last frame of the other one.
  bool isLaterThan(const PlacedSubmap& other) const { return first_frame > other.last_frame; }
  /// Whether it has seen the voxel there to be free, and those next to it: a thin thing that lies a voxel beside its
  /// place, because two submaps differ by this much, has not gone.
  bool sawFreeAround(const Eigen::Vector3d& place_map_m) const;
  /// The same voxels at the same place.
  bool isSame(const PlacedSubmap& other) const;
};

/// In the order of the layer.
std::vector<PlacedSubmap> placedSubmaps(const common::Map3dLayer& layer);

/// Those of `submaps` that are later than the submap and may overlap it.
std::vector<PlacedSubmap> laterThan(const PlacedSubmap& submap, const std::vector<PlacedSubmap>& submaps);

/// Whether one of the later submaps has seen the place free, at which an earlier one shows something.
bool hasGone(const std::vector<PlacedSubmap>& later, const Eigen::Vector3d& place_map_m);

}  // namespace swiftlet::autonomy
