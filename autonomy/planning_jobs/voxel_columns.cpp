#include "autonomy/planning_jobs/voxel_columns.hpp"

#include <algorithm>
#include <cmath>

#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

/// The floor is no obstacle: its voxels, and one more for their noise.
constexpr double kFloorNoise_m = 0.10;
/// A voxel is occupied with the evidence of two frames, in log odds: a single one may have met a mixed pixel.
constexpr int kOccupiedEvidence = static_cast<int>(1.5 / common::VoxelMap::kLogOddsStep);
/// A submap reaches as far around its origin as a depth camera sees.
constexpr double kColumnsReach_m = 6.0;

}  // namespace

VoxelColumns::VoxelColumns(const common::Map3dLayer& layer, double low_m, double high_m,
                           const Eigen::Vector2d& around_map_m, double reach_m)
    : low_m_(std::max(low_m, kFloorNoise_m)), high_m_(high_m) {
  const std::vector<PlacedSubmap> submaps = placedSubmaps(layer);
  for (const PlacedSubmap& submap : submaps)
    if ((submap.T_submap_map * around_map_m).norm() <= reach_m + kColumnsReach_m)
      sources_.push_back({submap, laterThan(submap, submaps)});
}

ColumnState VoxelColumns::at(const Eigen::Vector2d& place_map_m) const {
  states_.clear();
  for (const Source& source : sources_) {
    mark(source, place_map_m, states_);
    if (std::find(states_.begin(), states_.end(), ColumnState::kOccupied) != states_.end())
      return ColumnState::kOccupied;
  }
  const bool seen =
      !states_.empty() && std::find(states_.begin(), states_.end(), ColumnState::kUnknown) == states_.end();
  return seen ? ColumnState::kFree : ColumnState::kUnknown;
}

/// Adds the evidence of one submap on each voxel of the column. A voxel that it saw free may be unseen in others.
void VoxelColumns::mark(const Source& source, const Eigen::Vector2d& place_map_m,
                        std::vector<ColumnState>& states) const {
  using common::VoxelBlock;
  using common::VoxelMap;
  const VoxelMap& voxels = *source.submap.voxels;
  const Eigen::Vector2d place_m = source.submap.T_submap_map * place_map_m;
  const common::VoxelIndex low = voxels.voxelAt({place_m.x(), place_m.y(), low_m_});
  const int highest = voxels.voxelAt({place_m.x(), place_m.y(), high_m_}).z;
  states.resize(static_cast<std::size_t>(highest - low.z + 1), ColumnState::kUnknown);
  const VoxelBlock* block = nullptr;
  for (common::VoxelIndex voxel = low; voxel.z <= highest; ++voxel.z) {
    const int offset = VoxelBlock::offsetOf(voxel);
    if (voxel.z == low.z || (voxel.z & (VoxelBlock::kSide - 1)) == 0) block = voxels.block(VoxelMap::blockOf(voxel));
    if (block == nullptr) continue;
    const int evidence = block->evidence[static_cast<std::size_t>(offset)];
    if (evidence == VoxelBlock::kUnknown) continue;
    ColumnState& state = states[static_cast<std::size_t>(voxel.z - low.z)];
    if (evidence >= kOccupiedEvidence &&
        !hasGone(source.later, {place_map_m.x(), place_map_m.y(), voxels.centerOf(voxel).z()}))
      state = ColumnState::kOccupied;
    if (evidence <= 0 && state == ColumnState::kUnknown) state = ColumnState::kFree;
  }
}

}  // namespace swiftlet::autonomy
