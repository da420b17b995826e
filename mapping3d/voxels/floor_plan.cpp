#include "mapping3d/voxels/floor_plan.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::mapping3d {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

common::OccupancyGrid floorPlan(const VoxelMap& map, double low_m, double high_m) {
  common::OccupancyGrid plan = common::makeOccupancyGrid(map.resolution_m());
  const int lowest = static_cast<int>(std::floor(low_m / map.resolution_m()));
  const int highest = static_cast<int>(std::floor(high_m / map.resolution_m()));
  for (const VoxelIndex block : map.blocks()) {
    const VoxelIndex first = VoxelMap::firstOf(block);
    for (int z = std::max(lowest, first.z); z <= std::min(highest, first.z + VoxelBlock::kSide - 1); ++z) {
      for (int y = first.y; y < first.y + VoxelBlock::kSide; ++y) {
        for (int x = first.x; x < first.x + VoxelBlock::kSide; ++x) {
          const std::int8_t evidence =
              map.block(block)->evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({x, y, z}))];
          if (evidence == VoxelBlock::kUnknown) continue;
          const auto cell = static_cast<common::occupancy::Cell>(
              std::clamp<int>(evidence, -common::occupancy::kMaxSteps, common::occupancy::kMaxSteps));
          // Unknown is less than any evidence, so the greatest evidence of the column remains.
          if (cell > plan.at({x, y})) plan.set({x, y}, cell);
        }
      }
    }
  }
  return plan;
}

}  // namespace swiftlet::mapping3d
