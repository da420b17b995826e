#include "mapping3d/voxels/point_voxels.hpp"

namespace swiftlet::mapping3d {
namespace {

/// The greatest log odds of OctoMap's sensor model, 3.5.
constexpr auto kOccupied = static_cast<std::int8_t>(3.5 / common::VoxelMap::kLogOddsStep);
/// Half the voxels along an axis of OctoMap's trees.
constexpr double kReachVoxels = 32768.0;

}  // namespace

std::size_t occupiedCount(const common::VoxelMap& map) {
  std::size_t count = 0;
  for (const common::VoxelIndex index : map.blocks())
    for (const std::int8_t evidence : map.block(index)->evidence) count += evidence > 0 ? 1 : 0;
  return count;
}

std::vector<common::SurfacePoint> occupiedCenters(const common::VoxelMap& map) {
  using common::VoxelBlock;
  std::vector<common::SurfacePoint> points;
  for (const common::VoxelIndex index : map.blocks()) {
    const VoxelBlock& block = *map.block(index);
    for (int i = 0; i < VoxelBlock::kVoxels; ++i) {
      if (block.evidence[static_cast<std::size_t>(i)] <= 0) continue;
      const common::VoxelIndex voxel = common::VoxelMap::voxelOf(index, i);
      points.push_back({map.centerOf(voxel).cast<float>(), Eigen::Vector3f::Zero(), common::kUnknownColor});
    }
  }
  return points;
}

double octreeReach_m(double resolution_m) { return (kReachVoxels - 1.0) * resolution_m; }

PointVoxels voxelsAround(const std::vector<common::SurfacePoint>& points, double resolution_m,
                         std::size_t most_blocks) {
  PointVoxels voxels{common::VoxelMap(resolution_m)};
  const double reach_m = octreeReach_m(resolution_m);
  for (const common::SurfacePoint& point : points) {
    const Eigen::Vector3d position_m = point.position_m.cast<double>();
    if (position_m.allFinite() && position_m.cwiseAbs().maxCoeff() < reach_m)
      voxels.map.set(voxels.map.voxelAt(position_m), kOccupied);
    else
      ++voxels.left_out;
    voxels.full = voxels.map.blockCount() > most_blocks;
    if (voxels.full) break;
  }
  return voxels;
}

}  // namespace swiftlet::mapping3d
