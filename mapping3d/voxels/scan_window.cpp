#include "mapping3d/voxels/scan_window.hpp"

namespace swiftlet::mapping3d {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

// One block more on each side: the sensor may be anywhere in its block, and rounding may lead a ray one voxel farther.
ScanWindow::ScanWindow(int reach)
    : reach_blocks_((reach + VoxelBlock::kSide - 1) / VoxelBlock::kSide + 1), side_(2 * reach_blocks_ + 1) {
  slots_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_),
                -1);
}

void ScanWindow::moveTo(VoxelIndex sensor) {
  for (const SeenBlock& block : seen_) slots_[slotOf(block.block)] = -1;
  seen_.clear();
  const VoxelIndex block = VoxelMap::blockOf(sensor);
  first_ = {block.x - reach_blocks_, block.y - reach_blocks_, block.z - reach_blocks_};
}

SeenBlock& ScanWindow::make(VoxelIndex block) {
  slots_[slotOf(block)] = static_cast<int>(seen_.size());
  seen_.emplace_back();
  seen_.back().block = block;
  return seen_.back();
}

}  // namespace swiftlet::mapping3d
