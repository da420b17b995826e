#include "mapping3d/model/submap_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::Submap3d;

/// Depth images have far more pixels than a map with cubes of 2 cm needs points: every second pixel of a row and of a
/// column makes one. Smaller cubes need all of them.
int pixelStep(double cube_m) { return cube_m < SubmapConfig().cube_m ? 1 : 2; }
/// Every third frame makes points; all frames change the occupancy.
constexpr std::uint64_t kFrameStep = 3;
/// Key scans are up to a metre apart, and over some ten metres the 2D map drifts by no more than a voxel.
constexpr int kNeighbouringScans = 10;

/// The discs in the frame of a submap, which is level.
std::vector<common::Disc> inSubmap(std::span<const common::Disc> people, const Pose3& T_submap_map) {
  std::vector<common::Disc> discs;
  for (const common::Disc& person : people) {
    const Eigen::Vector3d center(person.center_map_m.x(), person.center_map_m.y(), 0.0);
    discs.push_back({(T_submap_map * center).head<2>(), person.radius_m});
  }
  return discs;
}

double awayFrom(const Submap3d& submap, const Eigen::Vector3d& position_map_m, const common::KeyPoses& scans) {
  return (position_map_m - submap.T_map_submap(scans).position_m).head<2>().norm();
}

bool hasNeighbour(const std::set<int>& scans, int scan) {
  const auto at = scans.lower_bound(scan - kNeighbouringScans);
  return at != scans.end() && *at <= scan + kNeighbouringScans;
}

void setPoints(const WeightedPoints& points, Submap3d& submap) {
  submap.points = points.points;
  submap.coarse = points.points->size() - points.fine;
}

}  // namespace

void SubmapStore::Kept::take(WeightedPoints points) {
  setPoints(points, submap);
  weights = std::move(points.weights);
}

SubmapStore::SubmapStore(const SubmapConfig& config, const VoxelConfig& voxels, const vision::DepthNoiseConfig& noise)
    : config_(config), voxels_(voxels), noise_(noise) {}

void SubmapStore::draw(const PlacedFrame& placed, const common::KeyPoses& scans) {
  const Pose3 T_submap_map = enter({placed.T_map_camera.position_m, placed.scan, placed.piece}, scans).inverse();
  const Pose3 T_submap_camera = T_submap_map * placed.T_map_camera;
  growing_->voxels.insert(placed.frame.depth, placed.frame.camera, T_submap_camera,
                          inSubmap(placed.people, T_submap_map));
  if (growing_->frames++ % kFrameStep == 0 || placed.is_key_frame)
    growing_->points.add(surfacePoints(placed.still, pixelStep(config_.cube_m), config_.point_range_m, noise_),
                         T_submap_camera);
}

void SubmapStore::draw(const PlacedSweep& placed, const common::KeyPoses& scans) {
  if (placed.rays_scan.empty()) return;
  const Pose3 T_map_scan = scans.T_map_level(placed.scan);
  const Eigen::Vector3d sensor_map_m = T_map_scan * placed.rays_scan.front().origin_m;
  const Pose3 T_submap_map = enter({sensor_map_m, placed.scan}, scans).inverse();
  const Pose3 T_submap_scan = T_submap_map * T_map_scan;
  const Eigen::Matrix3d rotation = T_submap_scan.rotation.toRotationMatrix();
  const std::vector<common::Disc> people = inSubmap(placed.people, T_submap_map);
  std::vector<Ray> rays;
  std::vector<SeenPoint> points;
  rays.reserve(placed.rays_scan.size());
  for (const Ray& ray : placed.rays_scan) {
    rays.push_back(
        {rotation * ray.origin_m + T_submap_scan.position_m, rotation * ray.end_m + T_submap_scan.position_m});
    const Eigen::Vector3d& end_m = rays.back().end_m;
    if ((end_m - rays.back().origin_m).norm() > config_.point_range_m) continue;
    if (std::any_of(people.begin(), people.end(), [&](const auto& person) { return person.covers(end_m.head<2>()); }))
      continue;
    points.push_back({end_m.cast<float>(), Eigen::Vector3f::Zero(), common::kUnknownColor, placed.weight_1_m2});
  }
  growing_->voxels.insert(rays, people);
  growing_->points.add(points, {});
}

void SubmapStore::joinPieces(int from, int into) {
  for (Kept& kept : kept_)
    if (kept.piece == from) kept.piece = into;
}

Pose3 SubmapStore::enter(const Place& place, const common::KeyPoses& scans) {
  if (growing_) {
    const Kept& kept = kept_[growing_->index];
    if (kept.piece != place.piece || awayFrom(kept.submap, place.sensor_map_m, scans) > config_.reach_m) leave();
  }
  if (!growing_) {
    const auto at = known(place, scans);
    grow(at ? *at : add(place, scans));
  }
  Kept& kept = kept_[growing_->index];
  kept.scans.insert(place.scan);
  kept.submap.last_frame = frames_++;
  return kept.submap.T_map_submap(scans);
}

std::vector<Submap3d> SubmapStore::snapshot() {
  std::vector<Submap3d> submaps;
  submaps.reserve(kept_.size());
  for (const Kept& kept : kept_) submaps.push_back(kept.submap);
  if (growing_) {
    Submap3d& submap = submaps[growing_->index];
    setPoints(growing_->points.points(), submap);
    submap.voxels = std::make_shared<const common::VoxelMap>(growing_->voxels.snapshot());
  }
  return submaps;
}

/// The nearest one within reach, among the submaps whose key scans place the frame.
std::optional<std::size_t> SubmapStore::known(const Place& place, const common::KeyPoses& scans) const {
  std::optional<std::size_t> nearest;
  double least_m = config_.reach_m;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (kept_[i].piece != place.piece || !hasNeighbour(kept_[i].scans, place.scan)) continue;
    const double away_m = awayFrom(kept_[i].submap, place.sensor_map_m, scans);
    if (away_m > least_m) continue;
    least_m = away_m;
    nearest = i;
  }
  return nearest;
}

/// Adds an empty submap. Its voxels coincide with the map's as long as no correction moves it, so fusing loses nothing.
std::size_t SubmapStore::add(const Place& place, const common::KeyPoses& scans) {
  if (static_cast<int>(kept_.size()) >= config_.submaps_max) kept_.erase(kept_.begin());
  Pose3 T_map_submap;
  for (int i = 0; i < 2; ++i)
    T_map_submap.position_m[i] = std::round(place.sensor_map_m[i] / voxels_.resolution_m) * voxels_.resolution_m;
  Submap3d submap{place.scan, scans.T_map_level(place.scan).inverse() * T_map_submap,
                  std::make_shared<const std::vector<common::SurfacePoint>>(),
                  std::make_shared<const common::VoxelMap>(voxels_.resolution_m), config_.cube_m};
  submap.first_frame = submap.last_frame = frames_;
  kept_.push_back({std::move(submap), {}, {}, place.piece});
  return kept_.size() - 1;
}

void SubmapStore::grow(std::size_t index) {
  const Kept& kept = kept_[index];
  growing_.emplace(Growing{index, VoxelMapper(voxels_, *kept.submap.voxels), PointGrid(kept.submap.cube_m)});
  growing_->points.add(WeightedPoints{kept.submap.points, kept.weights, kept.submap.fine()});
}

void SubmapStore::leave() {
  Kept& kept = kept_[growing_->index];
  kept.take(growing_->points.points());
  kept.submap.voxels = std::make_shared<const common::VoxelMap>(growing_->voxels.snapshot());
  growing_.reset();
  forgetOldest();
  thinOldest();
}

/// At least one stays: the voxels of a single submap are limited by VoxelConfig.
void SubmapStore::forgetOldest() {
  std::size_t blocks = 0;
  for (const Kept& kept : kept_) blocks += kept.submap.voxels->blockCount();
  while (blocks > static_cast<std::size_t>(config_.blocks_max) && kept_.size() > 1) {
    blocks -= kept_.front().submap.voxels->blockCount();
    kept_.erase(kept_.begin());
  }
}

void SubmapStore::thinOldest() {
  std::size_t points = 0;
  for (const Kept& kept : kept_) points += kept.submap.points->size();
  while (points > static_cast<std::size_t>(config_.points_max)) {
    // The first of those with the smallest cubes.
    const auto dense = std::min_element(kept_.begin(), kept_.end(),
                                        [](const Kept& a, const Kept& b) { return a.submap.cube_m < b.submap.cube_m; });
    const std::size_t before = dense->submap.points->size();
    dense->submap.cube_m *= 2.0;
    dense->take(thinned({dense->submap.points, std::move(dense->weights), dense->submap.fine()}, dense->submap.cube_m));
    points -= before - dense->submap.points->size();
  }
}

}  // namespace swiftlet::mapping3d
