#include "mapping3d/voxels/clearance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

using common::UnknownSpace;
using common::UprightHull;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;

/// Between an upright cylinder and a cube along the axes; 0 where they meet.
double distance_m(const Vector3d& center_m, const UprightHull& hull, const Vector3d& least_m, double side_m) {
  const auto beyond = [&](int axis) {
    return std::max({least_m[axis] - center_m[axis], center_m[axis] - least_m[axis] - side_m, 0.0});
  };
  const double x_m = beyond(0), y_m = beyond(1);
  const double beside_m = std::max(std::sqrt(x_m * x_m + y_m * y_m) - hull.radius_m, 0.0);
  const double above_m = std::max(beyond(2) - 0.5 * hull.height_m, 0.0);
  return std::sqrt(beside_m * beside_m + above_m * above_m);
}

Vector3d cornerOf(VoxelIndex index, double side_m) { return Vector3d(index.x, index.y, index.z) * side_m; }

double blockSide_m(const VoxelMap& map) { return VoxelBlock::kSide * map.resolution_m(); }

/// Voxel numbers of coordinates up to here are far from the limits of an int.
constexpr double kFarthest_m = 1e6;

}  // namespace

ClearanceField::ClearanceField(std::shared_ptr<const VoxelMap> map, double greatest_m)
    : greatest_m_(greatest_m), map_(std::move(map)) {}

/// Both versions exist while they are compared, so that equal addresses are equal blocks.
void ClearanceField::update(std::shared_ptr<const VoxelMap> map) {
  std::erase_if(obstacles_, [&](const auto& entry) {
    return map == nullptr || map_ == nullptr || map->resolution_m() != map_->resolution_m() ||
           map->block(entry.first) != entry.second.source;
  });
  map_ = std::move(map);
}

double ClearanceField::clearance_m(const Vector3d& center_map_m, const UprightHull& hull, UnknownSpace unknown) {
  if (!center_map_m.allFinite()) return 0.0;
  if (map_ == nullptr || center_map_m.cwiseAbs().maxCoeff() > kFarthest_m)
    return unknown == UnknownSpace::kFree ? greatest_m_ : 0.0;
  findBlocks(center_map_m, hull);
  // A heap, since mostly only the nearest few are looked at.
  const auto is_farther = [](const Near& a, const Near& b) { return a.distance_m > b.distance_m; };
  std::make_heap(near_.begin(), near_.end(), is_farther);
  double nearest_m = greatest_m_;
  while (!near_.empty() && near_.front().distance_m < nearest_m) {
    nearest_m = std::min(nearest_m, nearestIn(near_.front().block, center_map_m, hull, unknown, nearest_m));
    std::pop_heap(near_.begin(), near_.end(), is_farther);
    near_.pop_back();
  }
  return nearest_m;
}

/// Those within reach of the hull and the greatest clearance.
void ClearanceField::findBlocks(const Vector3d& center_m, const UprightHull& hull) {
  near_.clear();
  const double side_m = blockSide_m(*map_);
  const Vector3d reach_m(hull.radius_m + greatest_m_, hull.radius_m + greatest_m_, 0.5 * hull.height_m + greatest_m_);
  const VoxelIndex low = VoxelMap::blockOf(map_->voxelAt(center_m - reach_m));
  const VoxelIndex high = VoxelMap::blockOf(map_->voxelAt(center_m + reach_m));
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelIndex block{x, y, z};
        const double away_m = distance_m(center_m, hull, cornerOf(block, side_m), side_m);
        if (away_m < greatest_m_) near_.push_back({away_m, block});
      }
}

double ClearanceField::nearestIn(VoxelIndex block, const Vector3d& center_m, const UprightHull& hull,
                                 UnknownSpace unknown, double limit_m) {
  const VoxelBlock* content = map_->block(block);
  if (content == nullptr)
    return unknown == UnknownSpace::kFree
               ? limit_m
               : distance_m(center_m, hull, cornerOf(block, blockSide_m(*map_)), blockSide_m(*map_));
  const Obstacles& obstacles = obstaclesOf(block, *content);
  const VoxelBits& bits = unknown == UnknownSpace::kFree ? obstacles.occupied : obstacles.not_free;
  double nearest_m = limit_m;
  bits.forEach([&](int offset) {
    const Vector3d corner_m = cornerOf(VoxelMap::voxelOf(block, offset), map_->resolution_m());
    nearest_m = std::min(nearest_m, distance_m(center_m, hull, corner_m, map_->resolution_m()));
  });
  return nearest_m;
}

const ClearanceField::Obstacles& ClearanceField::obstaclesOf(VoxelIndex block, const VoxelBlock& content) {
  Obstacles& obstacles = obstacles_[block];
  if (obstacles.source == &content) return obstacles;
  obstacles = {&content, {}, {}};
  for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
    const std::int8_t evidence = content.evidence[static_cast<std::size_t>(offset)];
    if (evidence > 0) obstacles.occupied.set(offset);
    if (evidence > 0 || evidence == VoxelBlock::kUnknown) obstacles.not_free.set(offset);
  }
  return obstacles;
}

}  // namespace swiftlet::mapping3d
