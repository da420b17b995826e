// Octrees in the two file formats of OctoMap 1.x: .bt (a voxel is free, occupied or unknown) and .ot (log odds).
// Source: Hornung et al. 2013, section 4.3, and the files that OctoMap 1.9 writes.
//
// A codec of our own instead of OctoMap's: it goes straight between blocks and bytes, where a tree of nodes would take
// forty times the memory, and its recursion is bounded whatever the file holds, where OctoMap's ends the program by a
// stack overflow. Tests let OctoMap read what is written, and write what is read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

enum class OctreeFormat {
  kBinary,   ///< .bt
  kLogOdds,  ///< .ot
};

/// Blocks of a map, of 0.6 kB each, that one file may fill.
inline constexpr std::size_t kMostOctreeBlocks = 2'000'000;

/// By the ending of the name. Throws InputError for any other ending than .bt and .ot.
OctreeFormat octreeFormatOf(const std::filesystem::path& file);

/// Eight equal voxels, or cubes of them, become one leaf, as OctoMap prunes its trees. In a .ot file an inner node has
/// the greatest log odds of its children. Log odds of 0, which are free here, are just below. Throws InputError if a
/// known voxel lies beyond the tree's 2^15 voxels.
std::string toOctree(const common::VoxelMap& map, OctreeFormat format);

/// Writes the map in one step, in the format of the name's ending.
[[nodiscard]] Written writeOctree(const std::filesystem::path& file, const common::VoxelMap& map);

/// An occupied leaf of a ColorOcTree: a cube of voxels from `first` on.
struct ColoredCube {
  common::VoxelIndex first;
  int side = 1;  ///< In voxels.
  std::array<std::uint8_t, 3> rgb{};
};

struct StoredOctree {
  common::VoxelMap map;
  std::vector<ColoredCube> colors;  ///< In the order of the file; empty if the kind of tree has no colours.
  std::vector<std::string> notes;   ///< What was left out, and how the file contradicts itself; for people.
};

/// The centres of the occupied voxels of a tree with colours, without normals.
std::vector<common::SurfacePoint> coloredCenters(const StoredOctree& octree);

/// Reads either format, plain or compressed by gzip, bzip2 or xz. A .bt file may hold any kind of tree, a .ot file one
/// of OctoMap's own: OcTree, OcTreeStamped (whose stamps are in no file), ColorOcTree or CountingOcTree, where what was
/// counted is occupied. Voxels of a .bt file get the least or the greatest log odds of OctoMap's sensor model, those of
/// a .ot file theirs, rounded to steps of common::VoxelMap::kLogOddsStep; what is occupied or free stays so.
/// Throws InputError, also for a tree that fills more than `most_blocks` blocks of the map.
StoredOctree readOctree(const std::filesystem::path& file, std::size_t most_blocks = kMostOctreeBlocks);
/// Reads the bytes of a file as readOctree() does. Messages use `name` as the file.
StoredOctree parseOctree(std::string_view bytes, const std::string& name, std::size_t most_blocks = kMostOctreeBlocks);

}  // namespace swiftlet::interfaces
