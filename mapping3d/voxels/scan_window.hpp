// The evidence of one frame on the voxels around its sensor, before it changes the map.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "common/voxel_map.hpp"

namespace swiftlet::mapping3d {

/// One bit for each voxel of a block.
class VoxelBits {
 public:
  void set(int offset) { words_[static_cast<std::size_t>(offset >> 6)] |= std::uint64_t{1} << (offset & 63); }
  void setAll() { words_.fill(~std::uint64_t{0}); }
  /// Sets those of four voxels in a row along x whose bit is set in `four`; the first is at `offset`, a multiple of 4.
  void setFour(int offset, unsigned four) {
    words_[static_cast<std::size_t>(offset >> 6)] |= std::uint64_t{four} << (offset & 63);
  }
  /// The voxels of a layer: x varies fastest, then y.
  std::uint64_t layer(int z) const { return words_[static_cast<std::size_t>(z)]; }
  bool any() const {
    std::uint64_t all = 0;
    for (const std::uint64_t word : words_) all |= word;
    return all != 0;
  }
  /// Calls visit(offset) for each bit that is set, in ascending order.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i)
      for (std::uint64_t word = words_[i]; word != 0; word &= word - 1)
        visit(static_cast<int>(64 * i) + std::countr_zero(word));
  }

 private:
  std::array<std::uint64_t, common::VoxelBlock::kVoxels / 64> words_{};
};

/// A block as one frame sees it: the voxels that its rays cross, and those in which they end.
struct SeenBlock {
  common::VoxelIndex block;
  VoxelBits crossed;
  VoxelBits hit;
};

/// The blocks in a cube around the sensor, as one frame sees them. One thread.
class ScanWindow {
 public:
  /// A window for sensors that see `reach` voxels far.
  explicit ScanWindow(int reach);

  /// Forgets the last frame; the sensor is in that voxel now.
  void moveTo(common::VoxelIndex sensor);

  /// The block, which must be in the window. Valid until the next call.
  SeenBlock& at(common::VoxelIndex block) {
    const int slot = slots_[slotOf(block)];
    return slot >= 0 ? seen_[static_cast<std::size_t>(slot)] : make(block);
  }

  /// First and last block of the window.
  common::VoxelIndex first() const { return first_; }
  common::VoxelIndex last() const { return {first_.x + side_ - 1, first_.y + side_ - 1, first_.z + side_ - 1}; }

  /// The blocks that were asked for, in that order.
  const std::vector<SeenBlock>& seen() const { return seen_; }

 private:
  std::size_t slotOf(common::VoxelIndex block) const {
    return static_cast<std::size_t>(((block.z - first_.z) * side_ + (block.y - first_.y)) * side_ + block.x - first_.x);
  }
  SeenBlock& make(common::VoxelIndex block);

  int reach_blocks_;
  int side_;  ///< In blocks.
  common::VoxelIndex first_;
  std::vector<int> slots_;  ///< Index into seen_, or -1.
  std::vector<SeenBlock> seen_;
};

}  // namespace swiftlet::mapping3d
