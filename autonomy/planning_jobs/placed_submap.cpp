#include "autonomy/planning_jobs/placed_submap.hpp"

#include <algorithm>

#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;

/// In log odds: with the usual sensor model, the evidence of three frames that saw only free space.
constexpr int kSurelyFree = static_cast<int>(-1.0 / common::VoxelMap::kLogOddsStep);

/// From the origin of a submap to the farthest that is seen while it is drawn into: it is left 2.5 m from its origin,
/// and voxels end after 5 m.
constexpr double kSubmapReach_m = 7.5;

bool isSurelyFree(std::int8_t evidence) { return evidence != VoxelBlock::kUnknown && evidence <= kSurelyFree; }

}  // namespace

bool PlacedSubmap::sawFreeAround(const Eigen::Vector3d& place_map_m) const {
  const Eigen::Vector2d place_m = T_submap_map * Eigen::Vector2d(place_map_m.head<2>());
  const VoxelIndex voxel = voxels->voxelAt({place_m.x(), place_m.y(), place_map_m.z()});
  if (!isSurelyFree(voxels->evidence(voxel))) return false;
  for (int z = voxel.z - 1; z <= voxel.z + 1; ++z)
    for (int y = voxel.y - 1; y <= voxel.y + 1; ++y)
      for (int x = voxel.x - 1; x <= voxel.x + 1; ++x)
        if (!isSurelyFree(voxels->evidence({x, y, z}))) return false;
  return true;
}

bool PlacedSubmap::isSame(const PlacedSubmap& other) const {
  const common::Pose2 &a = T_submap_map, &b = other.T_submap_map;
  return voxels == other.voxels && a.x_m == b.x_m && a.y_m == b.y_m && a.yaw_rad == b.yaw_rad;
}

std::vector<PlacedSubmap> placedSubmaps(const common::Map3dLayer& layer) {
  std::vector<PlacedSubmap> placed;
  placed.reserve(layer.submaps->size());
  for (const common::Submap3d& submap : *layer.submaps)
    placed.push_back(
        {submap.voxels, planar(submap.T_map_submap(*layer.keys)).inverse(), submap.first_frame, submap.last_frame});
  return placed;
}

std::vector<PlacedSubmap> laterThan(const PlacedSubmap& submap, const std::vector<PlacedSubmap>& submaps) {
  const Eigen::Vector2d origin_map_m = submap.T_submap_map.inverse().position_m();
  std::vector<PlacedSubmap> later;
  for (const PlacedSubmap& other : submaps)
    if (other.isLaterThan(submap) && (other.T_submap_map * origin_map_m).norm() < 2.0 * kSubmapReach_m)
      later.push_back(other);
  return later;
}

bool hasGone(const std::vector<PlacedSubmap>& later, const Eigen::Vector3d& place_map_m) {
  return std::any_of(later.begin(), later.end(),
                     [&](const PlacedSubmap& submap) { return submap.sawFreeAround(place_map_m); });
}

}  // namespace swiftlet::autonomy
