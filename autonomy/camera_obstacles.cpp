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
/// The height may change by this much before the voxels are read again.
constexpr double kSameHeight_m = 0.03;

std::vector<Eigen::Vector2d> columnsOf(const VoxelMap& voxels, int low, int high) {
  std::vector<Eigen::Vector2d> centers_m;
  for (const VoxelIndex block : voxels.blocks()) {
    const VoxelIndex first = VoxelMap::firstOf(block);
    if (first.z > high || first.z + VoxelBlock::kSide <= low) continue;
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
  return centers_m;
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
  if (grid_ && laser_grid_ == grid && same_map && same_height) return;
  laser_grid_ = grid_ = grid;
  layer_ = layer;
  cells_map_m_.clear();
  if (!layer) return;
  followHeight(height_m);
  readColumns(*layer->submaps);
  overlay(*layer);
}

void CameraObstacles::followHeight(double height_m) {
  if (height_m_ && std::abs(*height_m_ - height_m) <= kSameHeight_m) return;
  height_m_ = height_m;
  columns_.clear();
}

/// Only those of submaps that are new or have grown.
void CameraObstacles::readColumns(const std::vector<common::Submap3d>& submaps) {
  columns_.resize(submaps.size());
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    if (columns_[i].voxels == submaps[i].voxels) continue;
    const double resolution_m = submaps[i].voxels->resolution_m();
    const double low_m = std::max(*height_m_ - half_hull_m_ - kMargin_m, kFloor_m);
    const double high_m = *height_m_ + half_hull_m_ + kMargin_m;
    columns_[i] = {submaps[i].voxels,
                   columnsOf(*submaps[i].voxels, static_cast<int>(std::floor(low_m / resolution_m)),
                             static_cast<int>(std::floor(high_m / resolution_m))),
                   {},
                   nullptr,
                   {},
                   {}};
  }
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
