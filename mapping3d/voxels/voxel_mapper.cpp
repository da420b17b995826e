#include "mapping3d/voxels/voxel_mapper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "common/check.hpp"
#include "common/row_major.hpp"
#include "mapping3d/voxels/ray_walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

int steps(double log_odds) { return static_cast<int>(std::lround(log_odds / VoxelMap::kLogOddsStep)); }

/// What is added to a voxel in which rays of a frame end, or that they only cross, and the upper limit of the sum: the
/// values of Hornung et al. 2013, probabilities of 0.7, 0.4 and 0.97.
const int kHit = steps(0.85), kMiss = steps(-0.4), kGreatestSteps = steps(3.5);

constexpr int kLayer = VoxelBlock::kSide * VoxelBlock::kSide;
using Layer = std::array<std::int8_t, kLayer>;
using Row = std::array<std::int8_t, VoxelBlock::kSide>;

/// All bits of those voxels of a row whose bit is set in the index.
constexpr std::array<Row, 256> kRowMasks = [] {
  std::array<Row, 256> masks{};
  for (std::size_t bits = 0; bits < masks.size(); ++bits)
    for (std::size_t x = 0; x < masks[bits].size(); ++x)
      masks[bits][x] = (bits >> x & 1U) != 0 ? std::int8_t{-1} : std::int8_t{0};
  return masks;
}();

Layer maskOf(std::uint64_t layer) {
  Layer mask;
  for (int y = 0; y < VoxelBlock::kSide; ++y)
    std::memcpy(&mask[static_cast<std::size_t>(VoxelBlock::kSide * y)],
                kRowMasks[layer >> (VoxelBlock::kSide * y) & 0xFFU].data(), VoxelBlock::kSide);
  return mask;
}

bool isOnPerson(const Eigen::Vector3d& point_map_m, std::span<const common::Disc> people) {
  return std::any_of(people.begin(), people.end(),
                     [&](const common::Disc& person) { return person.covers(point_map_m.head<2>()); });
}

/// What ends on a person is no surface.
constexpr int kOnPerson = -3;

void leaveOut(std::span<const common::Disc> people, const common::PinholeCamera& camera,
              const common::Pose3& T_map_camera, int u, int v, int count, const float* depth_m,
              DepthEnds::Chunk& chunk) {
  const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix();
  for (int i = 0; i < count; ++i) {
    int& x = chunk.x[static_cast<std::size_t>(i)];
    if (x < 0) continue;
    const Eigen::Vector3d end_map_m =
        T_map_camera.position_m + rotation * camera.point_camera_m(u + i, v, static_cast<double>(depth_m[i]));
    if (isOnPerson(end_map_m, people)) x = kOnPerson;
  }
}

}  // namespace

VoxelMapper::VoxelMapper(const VoxelConfig& config) : VoxelMapper(config, common::VoxelMap(config.resolution_m)) {}

VoxelMapper::VoxelMapper(const VoxelConfig& config, const common::VoxelMap& map)
    : config_(config),
      least_(steps(config.least_log_odds)),
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
  free_m_.resize(depth.depth_m.size());
  const DepthEnds ends(camera, T_map_camera, VoxelMap::firstOf(window_.first()), config_.resolution_m);
  DepthEnds::Chunk chunk;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; u += DepthEnds::kChunk) {
      const int count = std::min(DepthEnds::kChunk, camera.width_px - u);
      const std::size_t pixel = common::rowMajor(v, camera.width_px, u);
      ends.find(u, v, count, &depth.depth_m[pixel], &range_depths_m_[pixel], &free_m_[pixel], chunk);
      if (!people.empty()) leaveOut(people, camera, T_map_camera, u, v, count, &depth.depth_m[pixel], chunk);
      mark(chunk, count, counts);
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

void VoxelMapper::mark(const DepthEnds::Chunk& chunk, int count, InsertionCounts& counts) {
  const VoxelIndex first = VoxelMap::firstOf(window_.first());
  int last_x = -1, last_y = -1, last_z = -1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const int x = chunk.x[i], y = chunk.y[i], z = chunk.z[i];
    if (x < 0) {
      ++(x == DepthEnds::Chunk::kUnknown  ? counts.unknown
         : x == DepthEnds::Chunk::kTooFar ? counts.too_far
                                          : counts.ignored);
      continue;
    }
    ++counts.hits;
    // Neighbouring pixels mostly end in the same voxel.
    if (x == last_x && y == last_y && z == last_z) continue;
    markHit({first.x + x, first.y + y, first.z + z});
    last_x = x;
    last_y = y;
    last_z = z;
  }
}

/// The depths at the end of the range; computed again only for another camera.
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

/// Layer by layer, in numbers of eight bits: evidence is limited before it is added to, so that no sum leaves them.
void VoxelMapper::applyTo(VoxelBlock& block, const SeenBlock& seen) const {
  const auto hit = static_cast<std::int8_t>(kHit), miss = static_cast<std::int8_t>(kMiss);
  const auto ceiling = static_cast<std::int8_t>(kGreatestSteps - kHit),
             floor = static_cast<std::int8_t>(least_ - kMiss);
  for (int z = 0; z < VoxelBlock::kSide; ++z) {
    std::int8_t* evidence = &block.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({0, 0, z}))];
    const std::uint64_t ends = seen.hit.layer(z), touched = seen.crossed.layer(z) | ends;
    if (touched == 0) continue;
    if (~touched == 0 && ends == 0) {
      for (int i = 0; i < kLayer; ++i) {
        const std::int8_t before = evidence[i] == VoxelBlock::kUnknown ? std::int8_t{0} : evidence[i];
        evidence[i] = static_cast<std::int8_t>((before > floor ? before : floor) + miss);
      }
      continue;
    }
    const Layer end_mask = maskOf(ends), touched_mask = maskOf(touched);
    for (std::size_t i = 0; i < kLayer; ++i) {
      const std::int8_t before = evidence[i] == VoxelBlock::kUnknown ? std::int8_t{0} : evidence[i];
      const auto lowered = static_cast<std::int8_t>((before > floor ? before : floor) + miss);
      const auto raised = static_cast<std::int8_t>((before < ceiling ? before : ceiling) + hit);
      const auto after = static_cast<std::int8_t>((raised & end_mask[i]) | (lowered & ~end_mask[i]));
      evidence[i] = static_cast<std::int8_t>((after & touched_mask[i]) | (evidence[i] & ~touched_mask[i]));
    }
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
