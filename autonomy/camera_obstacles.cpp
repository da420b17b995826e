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
/// What the laser sees is in the grid already. The maps differ by up to this many cells, which must not narrow doors.
constexpr int kNearLaser_cells = 2;
/// This many blocks are read in one update, two megabytes, and the submap that is begun is read to its end.
constexpr int kBlocksPerUpdate = 4000;
/// This many columns are checked in one update for vacated voxels, and the submap that is begun is finished.
constexpr int kAskedPerUpdate = 1000;
/// The height may change by this much before the voxels are read again.
constexpr double kSameHeight_m = 0.03;

std::map<int, std::vector<VoxelIndex>> layersOf(const VoxelMap& voxels) {
  std::map<int, std::vector<VoxelIndex>> layers;
  for (const VoxelIndex block : voxels.blocks()) layers[block.z].push_back(block);
  return layers;
}

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
                             const std::shared_ptr<const common::OccupancyGrid>& grid,
                             const Eigen::Vector3d& body_map_m) {
  const double height_m = body_map_m.z();
  const bool same_map =
      layer_ == layer || (layer_ && layer && layer_->submaps == layer->submaps && layer_->keys == layer->keys);
  const bool same_height = height_m_ && std::abs(*height_m_ - height_m) <= kSameHeight_m;
  if (grid_ && laser_grid_ == grid && same_map && same_height && !unread_) return;
  laser_grid_ = grid_ = grid;
  layer_ = layer;
  cells_map_m_.clear();
  if (!layer) return;
  if (!same_height) height_m_ = height_m;
  const std::vector<PlacedSubmap> submaps = placedSubmaps(*layer);
  const std::vector<std::size_t> order = nearestFirst(submaps, body_map_m.head<2>());
  unread_ = false;
  readColumns(submaps, order);
  findGone(submaps, order);
  overlay();
}

/// Of submaps that are new, have grown, or were read for another height.
void CameraObstacles::readColumns(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order) {
  columns_.resize(submaps.size());
  int left = kBlocksPerUpdate;
  for (const std::size_t i : order) {
    const auto& voxels = submaps[i].voxels;
    Columns& columns = columns_[i];
    if (columns.voxels != voxels) {
      columns = {};
      columns.voxels = voxels;
      columns.layers = layersOf(*voxels);
    }
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
  columns.all.clear();
  columns.laser_grid = nullptr;
  int blocks = 0;
  const int lowest = VoxelMap::blockOf({0, 0, low}).z, highest = VoxelMap::blockOf({0, 0, high}).z;
  for (auto layer = columns.layers.lower_bound(lowest); layer != columns.layers.end() && layer->first <= highest;
       ++layer) {
    for (const VoxelIndex block : layer->second) addColumns(*columns.voxels, block, low, high, columns.all);
    blocks += static_cast<int>(layer->second.size());
  }
  return blocks;
}

/// The voxels of the block in which something is from `low` to `high`.
void CameraObstacles::addColumns(const VoxelMap& voxels, VoxelIndex block, int low, int high,
                                 std::vector<Column>& columns) {
  const VoxelIndex first = VoxelMap::firstOf(block);
  const VoxelBlock& content = *voxels.block(block);
  const int bottom = std::max(low, first.z), top = std::min(high, first.z + VoxelBlock::kSide - 1);
  for (int y = first.y; y < first.y + VoxelBlock::kSide; ++y)
    for (int x = first.x; x < first.x + VoxelBlock::kSide; ++x) {
      Column column{{x, y, first.z}};
      for (int z = bottom; z <= top; ++z)
        if (content.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({x, y, z}))] >= kLeastEvidence)
          column.occupied = static_cast<std::uint8_t>(column.occupied | 1U << (z - first.z));
      if (column.occupied != 0) columns.push_back(column);
    }
}

/// Again only if its submap was moved or the laser has changed the grid there, so that a large map costs little.
void CameraObstacles::findBesideLaser(Columns& columns, const PlacedSubmap& submap) const {
  if (columns.laser_grid && columns.placed.isSame(submap) && isSame(*columns.laser_grid, *laser_grid_, columns.around))
    return;
  columns.laser_grid = laser_grid_;
  columns.placed = submap;
  columns.around = {};
  columns.beside_laser.clear();
  columns.later.clear();
  const common::Pose2 T_map_submap = submap.T_submap_map.inverse();
  for (Column column : columns.all) {
    column.cell = laser_grid_->cellAt(T_map_submap * Eigen::Vector2d(submap.voxels->centerOf(column.bottom).head<2>()));
    include(column.cell, columns.around);
    if (!common::occupiedNear(*laser_grid_, column.cell, kNearLaser_cells)) columns.beside_laser.push_back(column);
  }
}

/// Again only if a later submap was moved or has grown.
void CameraObstacles::findGone(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order) {
  int left = kAskedPerUpdate;
  for (const std::size_t i : order) {
    Columns& columns = columns_[i];
    findBesideLaser(columns, submaps[i]);
    std::vector<PlacedSubmap> later = laterThan(submaps[i], submaps);
    const bool same = std::equal(later.begin(), later.end(), columns.later.begin(), columns.later.end(),
                                 [](const auto& a, const auto& b) { return a.isSame(b); });
    if (columns.beside_laser.empty() || same) continue;
    if (left <= 0) {
      unread_ = true;
      continue;
    }
    columns.later = std::move(later);
    for (Column& column : columns.beside_laser) column.gone = hasGone(columns, column);
    left -= static_cast<int>(columns.beside_laser.size());
  }
}

bool CameraObstacles::hasGone(const Columns& columns, const Column& column) {
  const common::Pose2 T_map_submap = columns.placed.T_submap_map.inverse();
  for (int i = 0; i < VoxelBlock::kSide; ++i) {
    if ((column.occupied >> i & 1U) == 0) continue;
    Eigen::Vector3d place_m = columns.voxels->centerOf({column.bottom.x, column.bottom.y, column.bottom.z + i});
    place_m.head<2>() = T_map_submap * Eigen::Vector2d(place_m.head<2>());
    if (!autonomy::hasGone(columns.later, place_m)) return false;
  }
  return true;
}

void CameraObstacles::overlay() {
  auto grid = std::make_shared<common::OccupancyGrid>(*laser_grid_);
  for (const Columns& columns : columns_)
    for (const Column& column : columns.beside_laser) {
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
