// A 3D occupancy map in hashed blocks. A copy takes O(blocks): copies share their blocks until one of them writes.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

/// A voxel, or a block of voxels, by its number along each axis; number 0 begins at the origin of the map's frame.
struct VoxelIndex {
  int x = 0;
  int y = 0;
  int z = 0;
  auto operator<=>(const VoxelIndex&) const = default;
};

/// A cube of voxels. Each holds the log odds of being occupied in steps of VoxelMap::kLogOddsStep, or kUnknown.
struct VoxelBlock {
  static constexpr int kSideBits = 3;
  static constexpr int kSide = 1 << kSideBits;
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr std::int8_t kUnknown = -128;

  std::array<std::int8_t, kVoxels> evidence;  ///< x varies fastest, then y.

  VoxelBlock() { evidence.fill(kUnknown); }

  static constexpr int offsetOf(VoxelIndex voxel) {
    return (voxel.x & (kSide - 1)) | (voxel.y & (kSide - 1)) << kSideBits | (voxel.z & (kSide - 1)) << 2 * kSideBits;
  }
};

/// Voxels are unknown, free (log odds of 0 or less) or occupied. Reading where nothing was written gives unknown.
/// `snapshot()` returns a copy that shares all blocks; afterwards a write to either first clones the block it changes.
/// Two threads may use two copies; one copy belongs to one thread at a time.
class VoxelMap {
 public:
  /// 0.05: the usual log odds of OctoMap's sensor model (Hornung 2013), 0.85, -0.4, -2 and 3.5, are multiples of it.
  static constexpr double kLogOddsStep = 0.05;

  explicit VoxelMap(double resolution_m) : resolution_m_(resolution_m) {}

  double resolution_m() const { return resolution_m_; }
  VoxelIndex voxelAt(const Eigen::Vector3d& point_m) const;
  Eigen::Vector3d centerOf(VoxelIndex voxel) const {
    return Eigen::Vector3d(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5) * resolution_m_;
  }
  static VoxelIndex blockOf(VoxelIndex voxel) {
    return {voxel.x >> VoxelBlock::kSideBits, voxel.y >> VoxelBlock::kSideBits, voxel.z >> VoxelBlock::kSideBits};
  }
  /// The first voxel of a block.
  static VoxelIndex firstOf(VoxelIndex block) {
    return {block.x * VoxelBlock::kSide, block.y * VoxelBlock::kSide, block.z * VoxelBlock::kSide};
  }
  /// The voxel of a block whose VoxelBlock::offsetOf is `offset`.
  static VoxelIndex voxelOf(VoxelIndex block, int offset) {
    constexpr int kMask = VoxelBlock::kSide - 1;
    const VoxelIndex first = firstOf(block);
    return {first.x + (offset & kMask), first.y + (offset >> VoxelBlock::kSideBits & kMask),
            first.z + (offset >> 2 * VoxelBlock::kSideBits)};
  }

  /// The log odds in steps of kLogOddsStep; VoxelBlock::kUnknown where nothing is known.
  std::int8_t evidence(VoxelIndex voxel) const;
  bool isKnown(VoxelIndex voxel) const { return evidence(voxel) != VoxelBlock::kUnknown; }
  bool isOccupied(VoxelIndex voxel) const { return evidence(voxel) > 0; }
  bool isFree(VoxelIndex voxel) const { return isKnown(voxel) && !isOccupied(voxel); }

  /// Null where the block does not exist.
  const VoxelBlock* block(VoxelIndex block) const;
  /// A reference for writing; makes or clones the block. Valid until the block is removed or a snapshot is taken.
  VoxelBlock& mutableBlock(VoxelIndex block);
  void set(VoxelIndex voxel, std::int8_t evidence) {
    mutableBlock(blockOf(voxel)).evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(voxel))] = evidence;
  }
  void remove(VoxelIndex block) { blocks_.erase(block); }

  /// In ascending order, so that what is made of them is the same for the same map.
  std::vector<VoxelIndex> blocks() const;
  std::size_t blockCount() const { return blocks_.size(); }
  std::size_t bytes() const;

  VoxelMap snapshot();

  /// For tables of blocks.
  struct Hash {
    std::size_t operator()(const VoxelIndex& block) const;
  };

 private:
  /// `shared` means that another map may hold the same block, which must then be cloned before writing. Only
  /// snapshot() sets it. It is not derived from use_count(), because other threads change that.
  struct Slot {
    std::shared_ptr<VoxelBlock> block;
    bool shared = false;
  };

  double resolution_m_;
  std::unordered_map<VoxelIndex, Slot, Hash> blocks_;
};

}  // namespace swiftlet::common
