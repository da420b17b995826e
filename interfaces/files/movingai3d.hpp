// Voxel maps and path problems of the Moving AI benchmarks, plain or compressed by gzip, bzip2 or xz. Paths go to the
// 26 neighbours and cut no corners.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/voxel_map.hpp"

namespace swiftlet::interfaces {

/// A `.3dmap` file: what it does not list is free.
struct VoxelListing {
  common::VoxelIndex size;
  std::vector<common::VoxelIndex> blocked;
};

/// Voxels of a map, at most: a quarter of a gigabyte with a bit for each.
inline constexpr double kMostListedVoxels = 2e9;

/// Throws InputError.
VoxelListing readVoxelListing(const std::filesystem::path& file);
/// Reads the bytes of a file as readVoxelListing() does. Messages use `name` as the file.
VoxelListing parseVoxelListing(std::string_view bytes, const std::string& name);

/// A line of a `.3dscen` file.
struct VoxelProblem {
  common::VoxelIndex start, goal;
  double optimal_length = 0.0;  ///< In voxels.
  int line = 0;                 ///< Of the file.
};

/// Throws InputError, also for problems that are not of a map of this size.
std::vector<VoxelProblem> readVoxelProblems(const std::filesystem::path& file, common::VoxelIndex size);
std::vector<VoxelProblem> parseVoxelProblems(std::string_view bytes, const std::string& name, common::VoxelIndex size);

}  // namespace swiftlet::interfaces
