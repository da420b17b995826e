#include "autonomy/planning_jobs/seen_volume.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

/// Submaps that were drawn into since the last fusion: one is left after 2.5 m of flight.
constexpr std::ptrdiff_t kNewest = 4;

void addWhereUnknown(const PlacedSubmap& submap, VoxelMap& seen) {
  const common::Pose2 T_map_submap = submap.T_submap_map.inverse();
  std::optional<VoxelIndex> last;
  VoxelBlock* target = nullptr;
  for (const VoxelIndex block : submap.voxels->blocks()) {
    const VoxelBlock& source = *submap.voxels->block(block);
    for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
      const std::int8_t evidence = source.evidence[static_cast<std::size_t>(offset)];
      if (evidence == VoxelBlock::kUnknown) continue;
      const Eigen::Vector3d center_m = submap.voxels->centerOf(VoxelMap::voxelOf(block, offset));
      const Eigen::Vector2d place_map_m = T_map_submap * Eigen::Vector2d(center_m.head<2>());
      const VoxelIndex voxel = seen.voxelAt({place_map_m.x(), place_map_m.y(), center_m.z()});
      if (const VoxelIndex in = VoxelMap::blockOf(voxel); !last || *last != in) {
        target = &seen.mutableBlock(in);
        last = in;
      }
      std::int8_t& there = target->evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(voxel))];
      if (there == VoxelBlock::kUnknown) there = evidence;
    }
  }
}

}  // namespace

std::shared_ptr<const VoxelMap> seenVolume(const common::Map3dLayer& layer) {
  const std::vector<PlacedSubmap> submaps = placedSubmaps(layer);
  if (submaps.empty()) return layer.fused;
  auto seen = std::make_shared<VoxelMap>(submaps.back().voxels->resolution_m());
  if (layer.fused)
    for (const VoxelIndex block : layer.fused->blocks()) seen->mutableBlock(block) = *layer.fused->block(block);
  // The newest first: what it knows counts before what an older one knows.
  const auto newest = std::min<std::ptrdiff_t>(kNewest, std::ssize(submaps));
  std::for_each(submaps.rbegin(), submaps.rbegin() + newest,
                [&](const PlacedSubmap& submap) { addWhereUnknown(submap, *seen); });
  return seen;
}

}  // namespace swiftlet::autonomy
