#include "common/voxel_map.hpp"

#include <algorithm>

namespace swiftlet::common {

VoxelIndex VoxelMap::voxelAt(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d voxel = (point_m / resolution_m_).array().floor();
  return {static_cast<int>(voxel.x()), static_cast<int>(voxel.y()), static_cast<int>(voxel.z())};
}

std::int8_t VoxelMap::evidence(VoxelIndex voxel) const {
  const VoxelBlock* found = block(blockOf(voxel));
  return found ? found->evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(voxel))] : VoxelBlock::kUnknown;
}

const VoxelBlock* VoxelMap::block(VoxelIndex block) const {
  const auto found = blocks_.find(block);
  return found == blocks_.end() ? nullptr : found->second.block.get();
}

VoxelBlock& VoxelMap::mutableBlock(VoxelIndex block) {
  Slot& slot = blocks_[block];
  if (!slot.block)
    slot = {std::make_shared<VoxelBlock>(), false};
  else if (slot.shared)
    slot = {std::make_shared<VoxelBlock>(*slot.block), false};
  return *slot.block;
}

std::vector<VoxelIndex> VoxelMap::blocks() const {
  std::vector<VoxelIndex> all;
  all.reserve(blocks_.size());
  for (const auto& [block, slot] : blocks_) all.push_back(block);
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t VoxelMap::bytes() const {
  // A node of the table holds its key, the slot and a pointer; a block has its reference counts beside it.
  constexpr std::size_t kNode = sizeof(VoxelIndex) + sizeof(Slot) + 2 * sizeof(void*);
  return blocks_.size() * (sizeof(VoxelBlock) + 2 * sizeof(void*) + kNode) + blocks_.bucket_count() * sizeof(void*);
}

VoxelMap VoxelMap::snapshot() {
  for (auto& [block, slot] : blocks_) slot.shared = true;
  return *this;
}

/// Teschner et al. 2003, "Optimized spatial hashing": three large primes.
std::size_t VoxelMap::Hash::operator()(const VoxelIndex& block) const {
  const auto part = [](int number, std::uint64_t prime) { return static_cast<std::uint64_t>(number) * prime; };
  const std::uint64_t hash = part(block.x, 73856093) ^ part(block.y, 19349663) ^ part(block.z, 83492791);
  return static_cast<std::size_t>(hash ^ (hash >> 17));
}

}  // namespace swiftlet::common
