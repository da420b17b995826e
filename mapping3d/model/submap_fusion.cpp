#include "mapping3d/model/submap_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/check.hpp"
#include "common/geometry.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;

/// The log odds that VoxelConfig allows, in steps: sums of several submaps must stay within what one could have.
constexpr int kLeastEvidence = -120, kGreatestEvidence = 120;

struct Source {
  const VoxelMap* voxels;
  Pose3 T_map_submap;
  Pose3 T_submap_map;
};

/// Adds to the evidence of a voxel; VoxelBlock::kUnknown adds nothing.
void addTo(std::int8_t& sum, std::int8_t evidence) {
  if (evidence == VoxelBlock::kUnknown) return;
  const int before = sum == VoxelBlock::kUnknown ? 0 : sum;
  sum = static_cast<std::int8_t>(std::clamp(before + evidence, kLeastEvidence, kGreatestEvidence));
}

/// The blocks of the map that a submap's block may reach, each with the submaps concerned in ascending order.
using Targets = std::map<VoxelIndex, std::vector<int>>;

void addTargets(const Source& source, int index, double side_m, Targets& targets) {
  const Eigen::Matrix3d rotation = source.T_map_submap.rotation.toRotationMatrix();
  const Vector3d half_m = rotation.cwiseAbs() * Vector3d::Constant(0.5 * side_m);
  const auto blockAt = [side_m](const Vector3d& point_m, double inward) {
    return (point_m / side_m + Vector3d::Constant(inward)).array().floor().cast<int>().eval();
  };
  for (const VoxelIndex block : source.voxels->blocks()) {
    const Vector3d center_m =
        source.T_map_submap * ((Vector3d(block.x, block.y, block.z).array() + 0.5).matrix() * side_m);
    // A block whose face only touches the next one does not reach into it.
    constexpr double kInward = 1e-6;
    const Eigen::Array3i low = blockAt(center_m - half_m, kInward), high = blockAt(center_m + half_m, -kInward);
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) {
          std::vector<int>& sources = targets[{x, y, z}];
          if (sources.empty() || sources.back() != index) sources.push_back(index);
        }
  }
}

/// Looks up the centre of every voxel of the block in one submap.
void addSource(const Source& source, VoxelIndex block, double resolution_m, VoxelBlock& sums) {
  const VoxelIndex first = VoxelMap::firstOf(block);
  const Eigen::Matrix3d step = source.T_submap_map.rotation.toRotationMatrix();
  const Vector3d corner = source.T_submap_map *
                          ((Vector3d(first.x, first.y, first.z).array() + 0.5).matrix() * resolution_m) / resolution_m;
  VoxelIndex last_block{};
  const VoxelBlock* found = nullptr;
  bool looked = false;
  std::size_t offset = 0;
  for (int z = 0; z < VoxelBlock::kSide; ++z)
    for (int y = 0; y < VoxelBlock::kSide; ++y)
      for (int x = 0; x < VoxelBlock::kSide; ++x, ++offset) {
        const Vector3d at = corner + step * Vector3d(x, y, z);
        const VoxelIndex voxel{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                               static_cast<int>(std::floor(at.z()))};
        const VoxelIndex in = VoxelMap::blockOf(voxel);
        if (!looked || in != last_block) found = source.voxels->block(in);
        looked = true;
        last_block = in;
        if (found != nullptr)
          addTo(sums.evidence[offset], found->evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(voxel))]);
      }
}

}  // namespace

VoxelMap fuse(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& scans, double resolution_m) {
  std::vector<Source> sources;
  Targets targets;
  for (const common::Submap3d& submap : submaps) {
    SWIFTLET_CHECK(submap.voxels->resolution_m() == resolution_m, submap.voxels->resolution_m(), resolution_m);
    const Pose3 T_map_submap = submap.T_map_submap(scans);
    sources.push_back({submap.voxels.get(), T_map_submap, T_map_submap.inverse()});
    addTargets(sources.back(), static_cast<int>(sources.size()) - 1, resolution_m * VoxelBlock::kSide, targets);
  }
  VoxelMap map(resolution_m);
  for (const auto& [block, indices] : targets) {
    VoxelBlock sums;
    for (const int index : indices) addSource(sources[static_cast<std::size_t>(index)], block, resolution_m, sums);
    if (std::any_of(sums.evidence.begin(), sums.evidence.end(),
                    [](std::int8_t evidence) { return evidence != VoxelBlock::kUnknown; }))
      map.mutableBlock(block) = sums;
  }
  return map;
}

}  // namespace swiftlet::mapping3d
