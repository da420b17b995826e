#include "autonomy/camera_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

/// This many blocks are read in one update, two megabytes, and the submap that is begun is read to its end.
constexpr int kBlocksPerUpdate = 4000;
/// This many columns are checked in one update for vacated voxels, and the submap that is begun is finished.
constexpr int kAskedPerUpdate = 1000;
/// The height may change by this much before the voxels are read again.
constexpr double kSameHeight_m = 0.03;

/// The submaps by the distance of their origins, those next to the vehicle first.
std::vector<std::size_t> nearestFirst(const std::vector<PlacedSubmap>& submaps, const Eigen::Vector2d& body_map_m) {
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t i = 0; i < submaps.size(); ++i)
    ranked.emplace_back((submaps[i].T_submap_map * body_map_m).squaredNorm(), i);
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> order;
  order.reserve(ranked.size());
  for (const auto& [distance_m2, i] : ranked) order.push_back(i);
  return order;
}

}  // namespace

void CameraObstacles::update(const std::shared_ptr<const common::Map3dLayer>& layer,
                             const std::shared_ptr<const common::OccupancyGrid>& grid,
                             const Eigen::Vector3d& body_map_m) {
  const double height_m = body_map_m.z();
  const bool same_map =
      layer_ == layer || (layer_ && layer && layer_->submaps == layer->submaps && layer_->keys == layer->keys);
  const bool same_height = height_m_ && std::abs(*height_m_ - height_m) <= kSameHeight_m;
  if (grid_ && laser_grid_ == grid && same_map && same_height && !unread_ && gone_.empty()) return;
  laser_grid_ = grid_ = grid;
  layer_ = layer;
  cells_map_m_.clear();
  if (!layer) return gone_.clear();
  if (!same_height) height_m_ = height_m;
  const std::vector<PlacedSubmap> submaps = placedSubmaps(*layer);
  const std::vector<std::size_t> order = nearestFirst(submaps, body_map_m.head<2>());
  unread_ = false;
  forgetGone(submaps);
  readColumns(order);
  findGone(submaps, order);
  overlay();
}

void CameraObstacles::forgetGone(const std::vector<PlacedSubmap>& submaps) {
  columns_.resize(submaps.size());
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    columns_[i].setVoxels(submaps[i].voxels);
    for (const perception::GoneColumn& gone : gone_)
      columns_[i].forget(submaps[i].T_submap_map * gone.place_map_m, gone.height_m);
  }
  gone_.clear();
}

/// Of submaps that are new, have grown, or were read for another height.
void CameraObstacles::readColumns(const std::vector<std::size_t>& order) {
  int left = kBlocksPerUpdate;
  for (const std::size_t i : order) {
    if (columns_[i].height_m() == height_m_) continue;
    if (left > 0)
      left -= columns_[i].read(*height_m_, half_hull_m_);
    else
      unread_ = true;
  }
}

void CameraObstacles::findGone(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order) {
  int left = kAskedPerUpdate;
  for (const std::size_t i : order) {
    columns_[i].findBesideLaser(submaps[i], laser_grid_);
    std::vector<PlacedSubmap> later = laterThan(submaps[i], submaps);
    if (columns_[i].knowsGone(later)) continue;
    if (left <= 0) {
      unread_ = true;
      continue;
    }
    columns_[i].findGone(std::move(later));
    left -= static_cast<int>(columns_[i].besideLaser().size());
  }
}

void CameraObstacles::overlay() {
  auto grid = std::make_shared<common::OccupancyGrid>(*laser_grid_);
  for (const SubmapColumns& columns : columns_)
    for (const Column& column : columns.besideLaser()) {
      if (column.gone || grid->at(column.cell) == common::occupancy::kMaxSteps) continue;
      grid->set(column.cell, common::occupancy::kMaxSteps);
      cells_map_m_.push_back(grid->centerOf(column.cell));
    }
  if (!cells_map_m_.empty()) grid_ = std::move(grid);
}

std::vector<Eigen::Vector2f> CameraObstacles::pointsNear_level_m(const common::Pose2& T_map_body,
                                                                 double range_m) const {
  const common::Pose2 T_body_map = T_map_body.inverse();
  std::vector<Eigen::Vector2f> points_level_m;
  for (const Eigen::Vector2d& cell_map_m : cells_map_m_)
    if ((cell_map_m - T_map_body.position_m()).norm() <= range_m)
      points_level_m.emplace_back((T_body_map * cell_map_m).cast<float>());
  return points_level_m;
}

}  // namespace swiftlet::autonomy
