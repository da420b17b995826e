#include "mapping3d/model/submap_store.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::Submap3d;

/// The discs in the frame of a submap, which is level.
std::vector<common::Disc> inSubmap(std::span<const common::Disc> people, const Pose3& T_submap_map) {
  std::vector<common::Disc> discs;
  for (const common::Disc& person : people) {
    const Eigen::Vector3d center(person.center_map_m.x(), person.center_map_m.y(), 0.0);
    discs.push_back({(T_submap_map * center).head<2>(), person.radius_m});
  }
  return discs;
}

}  // namespace

SubmapStore::SubmapStore(const SubmapConfig& config, const VoxelConfig& voxels, const vision::DepthNoiseConfig& noise)
    : config_(config), voxels_(voxels), noise_(noise) {}

void SubmapStore::draw(const PlacedFrame& placed, const common::KeyPoses& scans) {
  if (growing_) {
    const Eigen::Vector3d away_m = placed.T_map_camera.position_m - growing_->T_map_submap(scans).position_m;
    if (away_m.head<2>().norm() > config_.reach_m) leave();
  }
  if (!growing_) begin(placed, scans);
  const Pose3 T_submap_map = growing_->T_map_submap(scans).inverse();
  const Pose3 T_submap_camera = T_submap_map * placed.T_map_camera;
  growing_->voxels.insert(placed.frame.depth, placed.frame.camera, T_submap_camera,
                          inSubmap(placed.people, T_submap_map));
  const auto step = static_cast<std::uint64_t>(config_.frame_step);
  if (growing_->frames++ % step == 0 || placed.is_key_frame)
    growing_->points.add(surfacePoints(placed.still, config_.pixel_step, config_.point_range_m, noise_),
                         T_submap_camera);
}

std::vector<Submap3d> SubmapStore::snapshot() {
  std::vector<Submap3d> submaps;
  for (const Left& left : left_) submaps.push_back(left.submap);
  if (growing_)
    submaps.push_back({growing_->scan, growing_->T_scan_submap,
                       std::make_shared<const std::vector<common::SurfacePoint>>(growing_->points.points()),
                       std::make_shared<const common::VoxelMap>(growing_->voxels.snapshot())});
  return submaps;
}

/// The voxels of a new submap are those of the map as long as no correction moves it, so that fusing loses nothing.
void SubmapStore::begin(const PlacedFrame& placed, const common::KeyPoses& scans) {
  Pose3 T_map_submap;
  for (int i = 0; i < 2; ++i)
    T_map_submap.position_m[i] =
        std::round(placed.T_map_camera.position_m[i] / voxels_.resolution_m) * voxels_.resolution_m;
  growing_.emplace(Growing{placed.scan, scans.T_map_level(placed.scan).inverse() * T_map_submap, VoxelMapper(voxels_),
                           PointGrid(config_.cube_m)});
}

void SubmapStore::leave() {
  left_.push_back({std::move(snapshot().back()), config_.cube_m});
  growing_.reset();
  if (static_cast<int>(left_.size()) >= config_.submaps_max) left_.erase(left_.begin());
  thinOldest();
}

void SubmapStore::thinOldest() {
  std::size_t points = 0;
  for (const Left& left : left_) points += left.submap.points->size();
  while (points > static_cast<std::size_t>(config_.points_max)) {
    // The first of those with the smallest cubes.
    const auto dense =
        std::min_element(left_.begin(), left_.end(), [](const Left& a, const Left& b) { return a.cube_m < b.cube_m; });
    dense->cube_m *= 2.0;
    auto fewer =
        std::make_shared<const std::vector<common::SurfacePoint>>(thinned(*dense->submap.points, dense->cube_m));
    points -= dense->submap.points->size() - fewer->size();
    dense->submap.points = std::move(fewer);
  }
}

}  // namespace swiftlet::mapping3d
