#include "mapping3d/voxels/voxel_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/check.hpp"
#include "mapping3d/voxels/ray_walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

int steps(double log_odds) { return static_cast<int>(std::lround(log_odds / VoxelMap::kLogOddsStep)); }

/// Much faster than std::floor, which is a call without newer instructions than those of every x86-64.
int roundedDown(double number) {
  const int towards_zero = static_cast<int>(number);
  return towards_zero - (static_cast<double>(towards_zero) > number ? 1 : 0);
}

bool isOnPerson(const Eigen::Vector3d& point_map_m, std::span<const common::Disc> people) {
  return std::any_of(people.begin(), people.end(),
                     [&](const common::Disc& person) { return person.covers(point_map_m.head<2>()); });
}

}  // namespace

VoxelMapper::VoxelMapper(const VoxelConfig& config) : VoxelMapper(config, common::VoxelMap(config.resolution_m)) {}

VoxelMapper::VoxelMapper(const VoxelConfig& config, const common::VoxelMap& map)
    : config_(config),
      hit_(steps(config.hit_log_odds)),
      miss_(steps(config.miss_log_odds)),
      least_(steps(config.least_log_odds)),
      greatest_(steps(config.greatest_log_odds)),
      map_(map),
      window_(static_cast<int>(std::ceil(config.range_max_m / config.resolution_m))),
      carving_(config.range_max_m, config.resolution_m) {
  SWIFTLET_CHECK(map.resolution_m() == config.resolution_m, map.resolution_m(), config.resolution_m);
}

InsertionCounts VoxelMapper::insert(const common::DepthImage& depth, const common::PinholeCamera& camera,
                                    const common::Pose3& T_map_camera, std::span<const common::Disc> people) {
  SWIFTLET_CHECK(depth.width_px == camera.width_px && depth.height_px == camera.height_px, depth.width_px,
                 camera.width_px);
  window_.moveTo(map_.voxelAt(T_map_camera.position_m));
  followCamera(camera);
  InsertionCounts counts;
  free_m_.assign(depth.depth_m.size(), 0.0F);
  // In voxels, so that the numbers of a point's voxel are those of its coordinates rounded down.
  const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix() / config_.resolution_m;
  const Eigen::Vector3d origin = T_map_camera.position_m / config_.resolution_m;
  VoxelIndex last_hit{};
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++pixel) {
      const float depth_m = depth.depth_m[pixel];
      const bool too_far = depth_m == common::DepthImage::kTooFar;
      if (!too_far && !common::isMeasured(depth_m)) {
        ++counts.unknown;
        continue;
      }
      free_m_[pixel] = std::min(depth_m, range_depths_m_[pixel]);
      if (depth_m > range_depths_m_[pixel]) {
        ++counts.too_far;
        continue;
      }
      const Eigen::Vector3d end = origin + rotation * camera.point_camera_m(u, v, static_cast<double>(depth_m));
      const bool on_person = isOnPerson(end * config_.resolution_m, people);
      ++(on_person ? counts.ignored : counts.hits);
      if (on_person) continue;
      // Neighbouring pixels mostly end in the same voxel.
      const VoxelIndex hit{roundedDown(end.x()), roundedDown(end.y()), roundedDown(end.z())};
      if (counts.hits == 1 || hit != last_hit) markHit(hit);
      last_hit = hit;
    }
  }
  carving_.carve(free_m_, camera, T_map_camera, window_);
  apply();
  counts.forgotten = forgetFarBlocks(T_map_camera.position_m);
  return counts;
}

InsertionCounts VoxelMapper::insert(std::span<const Ray> rays_map, std::span<const common::Disc> people) {
  InsertionCounts counts;
  const double block_m = VoxelBlock::kSide * config_.resolution_m;
  const auto is_whole = [](const Ray& ray) { return ray.origin_m.allFinite() && ray.end_m.allFinite(); };
  const auto first = std::find_if(rays_map.begin(), rays_map.end(), is_whole);
  counts.unknown = static_cast<int>(first - rays_map.begin());
  if (first == rays_map.end()) return counts;
  window_.moveTo(map_.voxelAt(first->origin_m));
  for (auto ray = first; ray != rays_map.end(); ++ray) {
    if (!is_whole(*ray) || (ray->origin_m - first->origin_m).cwiseAbs().maxCoeff() > block_m) {
      ++counts.unknown;
      continue;
    }
    const Eigen::Vector3d along_m = ray->end_m - ray->origin_m;
    const double length_m = along_m.norm();
    if (length_m > config_.range_max_m) {
      ++counts.too_far;
      addRay(ray->origin_m, ray->origin_m + along_m * (config_.range_max_m / length_m), false);
      continue;
    }
    const bool on_person = isOnPerson(ray->end_m, people);
    ++(on_person ? counts.ignored : counts.hits);
    addRay(ray->origin_m, ray->end_m, !on_person);
  }
  apply();
  counts.forgotten = forgetFarBlocks(first->origin_m);
  return counts;
}

/// The depths at the end of the range, anew for another camera only.
void VoxelMapper::followCamera(const common::PinholeCamera& camera) {
  if (camera == camera_) return;
  camera_ = camera;
  range_depths_m_.clear();
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u)
      range_depths_m_.push_back(static_cast<float>(config_.range_max_m / camera.point_camera_m(u, v, 1.0).norm()));
}

/// As OctoMap's computeRayKeys: every voxel of the ray but its last.
void VoxelMapper::addRay(const Eigen::Vector3d& origin_map_m, const Eigen::Vector3d& end_map_m, bool hit) {
  RayWalk walk(origin_map_m / config_.resolution_m, end_map_m / config_.resolution_m);
  for (; !walk.atEnd(); walk.advance())
    window_.at(VoxelMap::blockOf(walk.cell())).crossed.set(VoxelBlock::offsetOf(walk.cell()));
  if (hit) markHit(walk.cell());
}

void VoxelMapper::markHit(VoxelIndex voxel) {
  window_.at(VoxelMap::blockOf(voxel)).hit.set(VoxelBlock::offsetOf(voxel));
}

void VoxelMapper::apply() {
  for (const SeenBlock& seen : window_.seen())
    if (seen.crossed.any() || seen.hit.any()) applyTo(map_.mutableBlock(seen.block), seen);
}

void VoxelMapper::applyTo(VoxelBlock& block, const SeenBlock& seen) const {
  for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
    const bool hit = seen.hit.has(offset);
    if (!hit && !seen.crossed.has(offset)) continue;
    std::int8_t& evidence = block.evidence[static_cast<std::size_t>(offset)];
    const int before = evidence == VoxelBlock::kUnknown ? 0 : evidence;
    evidence = static_cast<std::int8_t>(std::clamp(before + (hit ? hit_ : miss_), least_, greatest_));
  }
}

/// Down to nine tenths of the limit, so that it does not have to be done for every frame.
int VoxelMapper::forgetFarBlocks(const Eigen::Vector3d& origin_map_m) {
  const auto limit = static_cast<std::size_t>(config_.blocks_max);
  if (map_.blockCount() <= limit) return 0;
  std::vector<VoxelIndex> blocks = map_.blocks();
  const auto distance_m2 = [&](VoxelIndex block) {
    return (map_.centerOf(VoxelMap::firstOf(block)) - origin_map_m).squaredNorm();
  };
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](VoxelIndex a, VoxelIndex b) { return distance_m2(a) > distance_m2(b); });
  const std::size_t forgotten = blocks.size() - limit * 9 / 10;
  for (std::size_t i = 0; i < forgotten; ++i) map_.remove(blocks[i]);
  return static_cast<int>(forgotten);
}

}  // namespace swiftlet::mapping3d
