#include "autonomy/submap_columns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
/// A beam is this many voxels thick: its spot, and the errors of its height at a few metres.
constexpr int kBeam_voxels = 1;
/// What stands upright may have a hole of this many voxels, where a camera measured nothing.
constexpr int kGap_voxels = 2;
/// What the laser sees is in the grid already. The maps differ by up to this many cells, which must not narrow doors.
constexpr int kNearLaser_cells = 2;

std::map<int, std::vector<VoxelIndex>> layersOf(const VoxelMap& voxels) {
  std::map<int, std::vector<VoxelIndex>> layers;
  for (const VoxelIndex block : voxels.blocks()) layers[block.z].push_back(block);
  return layers;
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

void SubmapColumns::setVoxels(const std::shared_ptr<const VoxelMap>& voxels) {
  if (voxels_ == voxels) return;
  const auto forgotten = std::move(forgotten_);
  *this = {};
  voxels_ = voxels;
  layers_ = layersOf(*voxels);
  for (const auto& [voxel, least] : forgotten)
    if (const std::int8_t evidence = voxels->evidence(voxel); evidence <= least) forgotten_.emplace(voxel, evidence);
}

void SubmapColumns::forget(const Eigen::Vector2d& place_m, double height_m) {
  const VoxelIndex middle = voxels_->voxelAt({place_m.x(), place_m.y(), height_m});
  const std::size_t before = forgotten_.size();
  for (int y = middle.y - kNearLaser_cells; y <= middle.y + kNearLaser_cells; ++y)
    for (int x = middle.x - kNearLaser_cells; x <= middle.x + kNearLaser_cells; ++x)
      for (int z = middle.z - kBeam_voxels; z <= middle.z + kBeam_voxels; ++z) forgetUpright({x, y, z});
  if (forgotten_.size() > before) height_m_.reset();
}

/// The voxel and what is above and below it, up to the next gap.
void SubmapColumns::forgetUpright(VoxelIndex voxel) {
  if (!isOccupied(voxel, voxels_->evidence(voxel))) return;
  for (const int step : {1, -1}) {
    int gap = 0;
    for (VoxelIndex at = voxel; gap <= kGap_voxels; at.z += step) {
      const std::int8_t evidence = voxels_->evidence(at);
      gap = evidence >= kLeastEvidence ? 0 : gap + 1;
      if (gap == 0) forgotten_.insert({at, evidence});
    }
  }
}

bool SubmapColumns::isOccupied(VoxelIndex voxel, int evidence) const {
  return evidence >= kLeastEvidence && !forgotten_.contains(voxel);
}

int SubmapColumns::read(double height_m, double half_hull_m) {
  const double resolution_m = voxels_->resolution_m();
  const double low_m = std::max(height_m - half_hull_m - kMargin_m, kFloor_m);
  const double high_m = height_m + half_hull_m + kMargin_m;
  const int low = static_cast<int>(std::floor(low_m / resolution_m)),
            high = static_cast<int>(std::floor(high_m / resolution_m));
  height_m_ = height_m;
  all_.clear();
  laser_grid_ = nullptr;
  int blocks = 0;
  const int lowest = VoxelMap::blockOf({0, 0, low}).z, highest = VoxelMap::blockOf({0, 0, high}).z;
  for (auto layer = layers_.lower_bound(lowest); layer != layers_.end() && layer->first <= highest; ++layer) {
    for (const VoxelIndex block : layer->second) addColumns(block, low, high);
    blocks += static_cast<int>(layer->second.size());
  }
  return blocks;
}

/// The voxels of the block in which something is from `low` to `high`.
void SubmapColumns::addColumns(VoxelIndex block, int low, int high) {
  const VoxelIndex first = VoxelMap::firstOf(block);
  const VoxelBlock& content = *voxels_->block(block);
  const int bottom = std::max(low, first.z), top = std::min(high, first.z + VoxelBlock::kSide - 1);
  for (int y = first.y; y < first.y + VoxelBlock::kSide; ++y)
    for (int x = first.x; x < first.x + VoxelBlock::kSide; ++x) {
      Column column{{x, y, first.z}};
      for (int z = bottom; z <= top; ++z)
        if (isOccupied({x, y, z}, content.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({x, y, z}))]))
          column.occupied = static_cast<std::uint8_t>(column.occupied | 1U << (z - first.z));
      if (column.occupied != 0) all_.push_back(column);
    }
}

/// Again only if its submap was moved or the laser has changed the grid there.
void SubmapColumns::findBesideLaser(const PlacedSubmap& submap,
                                    const std::shared_ptr<const common::OccupancyGrid>& laser_grid) {
  if (laser_grid_ && placed_.isSame(submap) && isSame(*laser_grid_, *laser_grid, around_)) return;
  laser_grid_ = laser_grid;
  placed_ = submap;
  around_ = {};
  beside_laser_.clear();
  later_.clear();
  const common::Pose2 T_map_submap = submap.T_submap_map.inverse();
  for (Column column : all_) {
    column.cell = laser_grid_->cellAt(T_map_submap * Eigen::Vector2d(submap.voxels->centerOf(column.bottom).head<2>()));
    include(column.cell, around_);
    if (!common::occupiedNear(*laser_grid_, column.cell, kNearLaser_cells)) beside_laser_.push_back(column);
  }
}

bool SubmapColumns::knowsGone(const std::vector<PlacedSubmap>& later) const {
  return beside_laser_.empty() || std::equal(later.begin(), later.end(), later_.begin(), later_.end(),
                                             [](const auto& a, const auto& b) { return a.isSame(b); });
}

void SubmapColumns::findGone(std::vector<PlacedSubmap> later) {
  later_ = std::move(later);
  for (Column& column : beside_laser_) column.gone = hasGone(column);
}

bool SubmapColumns::hasGone(const Column& column) const {
  const common::Pose2 T_map_submap = placed_.T_submap_map.inverse();
  for (int i = 0; i < VoxelBlock::kSide; ++i) {
    if ((column.occupied >> i & 1U) == 0) continue;
    Eigen::Vector3d place_m = voxels_->centerOf({column.bottom.x, column.bottom.y, column.bottom.z + i});
    place_m.head<2>() = T_map_submap * Eigen::Vector2d(place_m.head<2>());
    if (!autonomy::hasGone(later_, place_m)) return false;
  }
  return true;
}

}  // namespace swiftlet::autonomy
