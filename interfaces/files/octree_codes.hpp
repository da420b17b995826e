// What the reader and the writer of OctoMap's files share.
#pragma once

#include <cstdint>

#include "common/voxel_map.hpp"

namespace swiftlet::interfaces::octree {

/// Levels below the root: a tree has 2^16 voxels along each axis, and the map's origin is in its middle.
inline constexpr int kDepth = 16;
inline constexpr int kMiddle = 1 << (kDepth - 1);
/// The level whose nodes are the blocks of a VoxelMap.
inline constexpr int kBlockDepth = kDepth - common::VoxelBlock::kSideBits;

/// Two bits for each child in a .bt file.
enum Child : std::uint8_t { kUnknownChild = 0b00, kFreeChild = 0b01, kOccupiedChild = 0b10, kInnerChild = 0b11 };

inline constexpr char kBinaryMagic[] = "# Octomap OcTree binary file";
inline constexpr char kLogOddsMagic[] = "# Octomap OcTree file";

/// OctoMap takes log odds of 0 as occupied, and we take it as free; so what is just free for us is written as this.
inline constexpr float kJustFree = -1e-7F;

/// The voxels of the child of a cube: x is the lowest bit of the child's number.
inline common::VoxelIndex childOf(common::VoxelIndex first, int half, int child) {
  return {first.x + half * (child & 1), first.y + half * (child >> 1 & 1), first.z + half * (child >> 2)};
}

}  // namespace swiftlet::interfaces::octree
