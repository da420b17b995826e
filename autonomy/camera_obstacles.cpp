#include "autonomy/camera_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "common/occupied_near.hpp"

namespace swiftlet::autonomy {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

/// Above and below the hull: as far as it rises and sinks while it flies at one height.
constexpr double kMargin_m = 0.15;
/// The floor is no obstacle: its voxels, and one more for their noise.
constexpr double kFloor_m = 0.10;
/// A voxel counts with the evidence of two frames, in log odds: a single one may have met a mixed pixel.
constexpr int kLeastEvidence = static_cast<int>(1.5 / VoxelMap::kLogOddsStep);
/// What the laser sees is in the grid already. The two maps differ by up to so many cells, which must not narrow doors.
constexpr int kNearLaser_cells = 2;
/// So many blocks are read in one update, two megabytes, and the submap that is begun is read to its end.
constexpr int kBlocksPerUpdate = 4000;
/// The height may change by this much before the voxels are read again.
constexpr double kSameHeight_m = 0.03;

std::map<int, std::vector<VoxelIndex>> layersOf(const VoxelMap& voxels) {
  std::map<int, std::vector<VoxelIndex>> layers;
  for (const VoxelIndex block : voxels.blocks()) layers[block.z].push_back(block);
  return layers;
}

/// The columns of a block in which something is from `low` to `high`.
void addColumns(const VoxelMap& voxels, VoxelIndex block, int low, int high, std::vector<Eigen::Vector2d>& centers_m) {
  const VoxelIndex first = VoxelMap::firstOf(block);
  const VoxelBlock& content = *voxels.block(block);
  const int bottom = std::max(low, first.z), top = std::min(high, first.z + VoxelBlock::kSide - 1);
  for (int y = first.y; y < first.y + VoxelBlock::kSide; ++y)
    for (int x = first.x; x < first.x + VoxelBlock::kSide; ++x)
      for (int z = bottom; z <= top; ++z)
        if (content.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({x, y, z}))] >= kLeastEvidence) {
          centers_m.emplace_back(voxels.centerOf({x, y, z}).head<2>());
          break;
        }
}

/// The submaps, those next to the camera first.
std::vector<std::size_t> nearestFirst(const common::Map3dLayer& layer) {
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t i = 0; i < layer.submaps->size(); ++i) {
    const Eigen::Vector3d origin_m = (*layer.submaps)[i].T_map_submap(*layer.keys).position_m;
    ranked.emplace_back((origin_m - layer.T_map_camera.position_m).head<2>().squaredNorm(), i);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> order;
  order.reserve(ranked.size());
  for (const auto& [distance_m2, i] : ranked) order.push_back(i);
  return order;
}

/// Enlarges the rectangle by the cells that decide whether the laser sees something near this one.
void include(common::CellIndex cell, common::CellRect& rect) {
  const common::CellIndex low{cell.x - kNearLaser_cells, cell.y - kNearLaser_cells};
  const common::CellIndex high{cell.x + kNearLaser_cells + 1, cell.y + kNearLaser_cells + 1};
  if (rect.empty()) {
    rect = {low, high};
    return;
  }
  rect.begin = {std::min(rect.begin.x, low.x), std::min(rect.begin.y, low.y)};
  rect.end = {std::max(rect.end.x, high.x), std::max(rect.end.y, high.y)};
}

bool isSame(const common::Pose2& a, const common::Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.yaw_rad == b.yaw_rad;
}

/// Whether two snapshots of a grid share their tiles there.
bool isSame(const common::OccupancyGrid& a, const common::OccupancyGrid& b, const common::CellRect& rect) {
  constexpr int kTile = common::OccupancyGrid::kTileSize;
  for (int y = rect.begin.y; y < rect.end.y + kTile; y += kTile)
    for (int x = rect.begin.x; x < rect.end.x + kTile; x += kTile) {
      const common::CellIndex cell{std::min(x, rect.end.x - 1), std::min(y, rect.end.y - 1)};
      if (a.tileIdentity(cell) != b.tileIdentity(cell)) return false;
    }
  return true;
}

}  // namespace

void CameraObstacles::update(const std::shared_ptr<const common::Map3dLayer>& layer,
                             const std::shared_ptr<const common::OccupancyGrid>& grid, double height_m) {
  const bool same_map =
      layer_ == layer || (layer_ && layer && layer_->submaps == layer->submaps && layer_->keys == layer->keys);
  const bool same_height = height_m_ && std::abs(*height_m_ - height_m) <= kSameHeight_m;
  if (grid_ && laser_grid_ == grid && same_map && same_height && !unread_) return;
  laser_grid_ = grid_ = grid;
  layer_ = layer;
  cells_map_m_.clear();
  if (!layer) return;
  followHeight(height_m);
  readColumns(*layer);
  overlay(*layer);
}

void CameraObstacles::followHeight(double height_m) {
  if (!height_m_ || std::abs(*height_m_ - height_m) > kSameHeight_m) height_m_ = height_m;
}

/// Of submaps that are new, have grown, or were read for another height.
void CameraObstacles::readColumns(const common::Map3dLayer& layer) {
  columns_.resize(layer.submaps->size());
  unread_ = false;
  int left = kBlocksPerUpdate;
  for (const std::size_t i : nearestFirst(layer)) {
    const auto& voxels = (*layer.submaps)[i].voxels;
    Columns& columns = columns_[i];
    if (columns.voxels != voxels) columns = {voxels, layersOf(*voxels), {}, {}, {}, nullptr, {}, {}};
    if (columns.height_m == height_m_) continue;
    if (left > 0)
      left -= read(columns);
    else
      unread_ = true;
  }
}

/// How many blocks it has read.
int CameraObstacles::read(Columns& columns) const {
  const double resolution_m = columns.voxels->resolution_m();
  const double low_m = std::max(*height_m_ - half_hull_m_ - kMargin_m, kFloor_m);
  const double high_m = *height_m_ + half_hull_m_ + kMargin_m;
  const int low = static_cast<int>(std::floor(low_m / resolution_m)),
            high = static_cast<int>(std::floor(high_m / resolution_m));
  columns.height_m = height_m_;
  columns.centers_submap_m.clear();
  columns.laser_grid = nullptr;
  int blocks = 0;
  const int lowest = VoxelMap::blockOf({0, 0, low}).z, highest = VoxelMap::blockOf({0, 0, high}).z;
  for (auto layer = columns.layers.lower_bound(lowest); layer != columns.layers.end() && layer->first <= highest;
       ++layer) {
    for (const VoxelIndex block : layer->second)
      addColumns(*columns.voxels, block, low, high, columns.centers_submap_m);
    blocks += static_cast<int>(layer->second.size());
  }
  return blocks;
}

/// Again only if its submap was moved or the laser has changed the grid there, so that a large map costs little.
void CameraObstacles::findCells(Columns& columns, const common::Pose2& T_map_submap) const {
  if (columns.laser_grid && isSame(columns.T_map_submap, T_map_submap) &&
      isSame(*columns.laser_grid, *laser_grid_, columns.around))
    return;
  columns.laser_grid = laser_grid_;
  columns.T_map_submap = T_map_submap;
  columns.around = {};
  columns.cells.clear();
  for (const Eigen::Vector2d& center_submap_m : columns.centers_submap_m) {
    const common::CellIndex cell = laser_grid_->cellAt(T_map_submap * center_submap_m);
    include(cell, columns.around);
    if (!common::occupiedNear(*laser_grid_, cell, kNearLaser_cells)) columns.cells.push_back(cell);
  }
}

void CameraObstacles::overlay(const common::Map3dLayer& layer) {
  auto grid = std::make_shared<common::OccupancyGrid>(*laser_grid_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    findCells(columns_[i], planar((*layer.submaps)[i].T_map_submap(*layer.keys)));
    for (const common::CellIndex cell : columns_[i].cells) {
      if (grid->at(cell) == common::occupancy::kMaxSteps) continue;
      grid->set(cell, common::occupancy::kMaxSteps);
      cells_map_m_.push_back(grid->centerOf(cell));
    }
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
