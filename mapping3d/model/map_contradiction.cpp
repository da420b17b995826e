#include "mapping3d/model/map_contradiction.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::VoxelIndex;

/// One point in this many is looked at.
constexpr std::size_t kSampleStep = 7;
/// Fewer points tell nothing.
constexpr std::uint64_t kLeastSeenTwice = 500;
/// Surfaces of different submaps may be this many voxels apart: noise and drift of a right map.
constexpr int kNear = 2;

bool isSurfaceNear(const common::VoxelMap& map, VoxelIndex at) {
  for (int z = -kNear; z <= kNear; ++z)
    for (int y = -kNear; y <= kNear; ++y)
      for (int x = -kNear; x <= kNear; ++x)
        if (map.isOccupied({at.x + x, at.y + y, at.z + z})) return true;
  return false;
}

/// Free itself, and known to be so around it.
bool isDeepInFree(const common::VoxelMap& map, VoxelIndex at) {
  for (const VoxelIndex side :
       {VoxelIndex{kNear, 0, 0}, {-kNear, 0, 0}, {0, kNear, 0}, {0, -kNear, 0}, {0, 0, kNear}, {0, 0, -kNear}})
    if (!map.isFree({at.x + side.x, at.y + side.y, at.z + side.z})) return false;
  return map.isFree(at);
}

void compare(const common::Submap3d& seen, const common::Submap3d& other, const common::KeyPoses& keys,
             MapContradiction& sums) {
  const common::Pose3 T_other_seen = other.T_map_submap(keys).inverse() * seen.T_map_submap(keys);
  for (std::size_t i = 0; i < seen.fine(); i += kSampleStep) {
    const VoxelIndex at = other.voxels->voxelAt(T_other_seen * (*seen.points)[i].position_m.cast<double>());
    if (!other.voxels->isKnown(at)) continue;
    const bool agrees = isSurfaceNear(*other.voxels, at);
    if (!agrees && !isDeepInFree(*other.voxels, at)) continue;
    ++sums.seen_twice;
    sums.contradicting += agrees ? 0 : 1;
  }
}

}  // namespace

double MapContradiction::share() const {
  return seen_twice < kLeastSeenTwice ? 0.0 : static_cast<double>(contradicting) / static_cast<double>(seen_twice);
}

MapContradiction contradictionOf(std::span<const common::Submap3d> submaps, const common::KeyPoses& keys) {
  MapContradiction sums;
  for (std::size_t i = 0; i < submaps.size(); ++i)
    for (std::size_t j = 0; j < submaps.size(); ++j)
      if (i != j) compare(submaps[i], submaps[j], keys, sums);
  return sums;
}

}  // namespace swiftlet::mapping3d
