#include "planning/clearance/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::VoxelIndex;
using Eigen::Vector3d;

int cellsOf(double reach_m, double resolution_m) {
  return std::clamp(static_cast<int>(std::ceil(reach_m / resolution_m)), 1, DistanceField::kMostReach);
}

/// Of the voxels that an upright hull meets whose middle is the centre of one.
std::optional<int> halfHeightOf(std::optional<double> hull_height_m, double voxel_m) {
  if (!hull_height_m) return std::nullopt;
  return std::max(0, static_cast<int>(std::ceil(0.5 * *hull_height_m / voxel_m + 0.5)) - 1);
}

/// People and zones over a grid, as cells whose centres are in one of them.
class Barred {
 public:
  Barred(const common::OccupancyGrid& grid, std::span<const common::Disc> discs,
         std::span<const common::Polygon> keep_out)
      : grid_(grid), discs_(discs), keep_out_(keep_out) {
    for (const common::Disc& disc : discs) {
      const Eigen::Vector2d corner = Eigen::Vector2d::Constant(disc.radius_m);
      add(disc.center_map_m - corner, disc.center_map_m + corner);
    }
    for (const common::Polygon& zone : keep_out) add(zone.min_map_m(), zone.max_map_m());
  }

  /// In cells of the grid, the grid's y along z; those of the discs first. A disc that is nowhere has an empty one.
  const std::vector<CellBox>& boxes() const { return boxes_; }

  /// Marks the cells of a row from `first` on that are in one of them.
  void mark(CellIndex first, std::span<std::uint8_t, DistanceField::kRow> occupied) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const CellBox& box = boxes_[i];
      if (first.y < box.begin.z || first.y >= box.end.z) continue;
      for (int x = std::max(first.x, box.begin.x); x < std::min(first.x + DistanceField::kRow, box.end.x); ++x) {
        const Eigen::Vector2d center_m = grid_.centerOf({x, first.y});
        if (i < discs_.size() ? discs_[i].covers(center_m) : keep_out_[i - discs_.size()].contains(center_m))
          occupied[static_cast<std::size_t>(x - first.x)] = 1;
      }
    }
  }

 private:
  void add(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m) {
    CellBox& box = boxes_.emplace_back();
    if (!low_m.allFinite() || !high_m.allFinite()) return;
    const CellIndex first = grid_.cellAt(low_m), last = grid_.cellAt(high_m);
    box = {{first.x, 0, first.y}, {last.x + 1, 1, last.y + 1}};
  }

  const common::OccupancyGrid& grid_;
  std::span<const common::Disc> discs_;
  std::span<const common::Polygon> keep_out_;
  std::vector<CellBox> boxes_;
};

CellBox moved(const CellBox& box, const VoxelIndex& by) {
  return {{box.begin.x - by.x, box.begin.y - by.y, box.begin.z - by.z},
          {box.end.x - by.x, box.end.y - by.y, box.end.z - by.z}};
}

}  // namespace

Clearance::Clearance(double resolution_m, bool plane, const Reach& reach, std::optional<double> hull_height_m)
    : resolution_m_(resolution_m),
      cells_per_m_(1.0 / resolution_m),
      plane_(plane),
      half_height_cells_(halfHeightOf(hull_height_m, resolution_m)),
      states_(resolution_m),
      voxels_(resolution_m) {
  int greatest = 0;
  for (Layer& layer : layers_) {
    layer.reach_cells = cellsOf(&layer == &layers_[1] ? reach.unseen_m : reach.things_m, resolution_m);
    layer.reach_m = layer.reach_cells * resolution_m;
    greatest = std::max(greatest, layer.reach_cells + 1);
  }
  for (int squared = 0; squared <= greatest * greatest; ++squared)
    distances_m_.push_back(std::sqrt(static_cast<double>(squared)) * resolution_m);
}

std::vector<CellBox> Clearance::update(const common::OccupancyGrid& grid, std::span<const common::Disc> discs,
                                       std::span<const common::Polygon> keep_out) {
  SWIFTLET_CHECK(plane_ && grid.resolution_m() == resolution_m_, grid.resolution_m(), resolution_m_);
  const std::vector<common::CellRect> changes = states_.update(grid);
  const common::CellRect rect = states_.rect();
  if (rect.empty()) return {};
  const VoxelIndex begin{rect.begin.x, 0, rect.begin.y}, end{rect.end.x, 1, rect.end.y};
  std::vector<CellBox> boxes;
  if (begin != begin_ || end != end_) {
    reshape(begin, end);
    boxes.push_back({{0, 0, 0}, {rect.width(), 1, rect.height()}});
  }
  for (const common::CellRect& change : changes)
    boxes.push_back({{change.begin.x, 0, change.begin.y}, {change.end.x, 1, change.end.y}});
  std::vector<CellBox> changed;
  for (const auto& [which, layer] : {std::pair(CellState::kOccupied, 0), std::pair(CellState::kUnknown, 1)}) {
    const auto read = [&, which = which](VoxelIndex first, std::span<std::uint8_t, DistanceField::kRow> is) {
      const auto row = states_.all().begin() + static_cast<std::ptrdiff_t>(first.z) * rect.width() + first.x;
      std::transform(row, row + is.size(), is.begin(), [which](CellState state) { return state == which; });
    };
    const std::vector<CellBox> of_layer = layers_[static_cast<std::size_t>(layer)].field.update(boxes, read);
    changed.insert(changed.end(), of_layer.begin(), of_layer.end());
  }
  updateBarred(grid, discs, keep_out);
  return changed;
}

/// Where people and zones were is read again, and where they are.
void Clearance::updateBarred(const common::OccupancyGrid& grid, std::span<const common::Disc> discs,
                             std::span<const common::Polygon> keep_out) {
  const Barred barred(grid, discs, keep_out);
  barred_.insert(barred_.end(), barred.boxes().begin(), barred.boxes().end());
  for (CellBox& box : barred_) box = moved(box, begin_);
  layers_[2].field.update(barred_, [&](VoxelIndex first, std::span<std::uint8_t, DistanceField::kRow> occupied) {
    std::fill(occupied.begin(), occupied.end(), std::uint8_t{0});
    barred.mark({begin_.x + first.x, begin_.z + first.z}, occupied);
  });
  barred_ = barred.boxes();
}

void Clearance::update(const common::VoxelMap& map) {
  SWIFTLET_CHECK(!plane_ && map.resolution_m() == resolution_m_, map.resolution_m(), resolution_m_);
  constexpr int kSide = common::VoxelBlock::kSide;
  const std::vector<VoxelIndex> blocks = map.blocks();
  if (blocks.empty()) return;
  VoxelIndex begin = blocks.front(), end = blocks.front();
  for (const VoxelIndex& block : blocks) {
    begin = {std::min(begin.x, block.x), std::min(begin.y, block.y), std::min(begin.z, block.z)};
    end = {std::max(end.x, block.x), std::max(end.y, block.y), std::max(end.z, block.z)};
  }
  begin = common::VoxelMap::firstOf({begin.x - 1, begin.y - 1, begin.z - 1});
  end = common::VoxelMap::firstOf({end.x + 2, end.y + 2, end.z + 2});
  std::vector<CellBox> boxes;
  if (begin != begin_ || end != end_) {
    reshape(begin, end);
    boxes.push_back({{0, 0, 0}, {end.x - begin.x, end.y - begin.y, end.z - begin.z}});
  } else {
    const auto add = [&](const VoxelIndex& block) {
      const VoxelIndex first = common::VoxelMap::firstOf(block);
      boxes.push_back(moved({first, {first.x + kSide, first.y + kSide, first.z + kSide}}, begin_));
    };
    for (const VoxelIndex& block : blocks)
      if (map.block(block) != voxels_.block(block)) add(block);
    for (const VoxelIndex& block : voxels_.blocks())
      if (map.block(block) == nullptr) add(block);
  }
  layers_[0].field.update(boxes, [&](VoxelIndex first, std::span<std::uint8_t, DistanceField::kRow> occupied) {
    const VoxelIndex from{begin_.x + first.x, begin_.y + first.y, begin_.z + first.z};
    for (int x = 0; x < DistanceField::kRow; x += kSide) {
      const common::VoxelBlock* block = map.block(common::VoxelMap::blockOf({from.x + x, from.y, from.z}));
      const int offset = common::VoxelBlock::offsetOf({from.x + x, from.y, from.z});
      const bool within = from.x + x < end_.x && from.y < end_.y && from.z < end_.z;
      for (int i = 0; i < kSide; ++i) {
        const std::int8_t evidence =
            block == nullptr ? common::VoxelBlock::kUnknown : block->evidence[static_cast<std::size_t>(offset + i)];
        occupied[static_cast<std::size_t>(x + i)] =
            within && (evidence == common::VoxelBlock::kUnknown || evidence > 0);
      }
    }
  });
  voxels_ = map;
}

void Clearance::reshape(const VoxelIndex& begin, const VoxelIndex& end) {
  begin_ = begin;
  end_ = end;
  barred_.clear();
  for (Layer& layer : layers_)
    if (plane_ || &layer == &layers_[0])
      layer.field =
          DistanceField({end.x - begin.x, end.y - begin.y, end.z - begin.z}, layer.reach_cells, half_height_cells_);
}

double Clearance::reach_m(Against against) const {
  if (!plane_) return layers_[0].reach_m;
  double least_m = kFar_m;
  for (const Against layer : {Against::kObstacles, Against::kUnseen, Against::kBarred})
    if (counts(layer, against)) least_m = std::min(least_m, layerOf(layer).reach_m);
  return least_m;
}

Clearance::NearestPlace Clearance::nearestOn(const Vector3d& from_map_m, const Vector3d& to_map_m, double enough_m,
                                             Against against) const {
  const Vector3d step_m = to_map_m - from_map_m;
  const double length_m = step_m.norm(), half_cell_m = 0.5 * resolution_m_;
  // A place that is d nearer to a thing is at least d farther along. The centres of its cell and of the next are each
  // half a diagonal off. A hull's clearance says nothing of other heights.
  const double off_m = std::sqrt(plane_ || half_height_cells_ ? 2.0 : 3.0) * resolution_m_;
  NearestPlace nearest{at_m(to_map_m, against), length_m};
  double before_m = 0.0;
  for (double at = 0.0;;) {
    const Vector3d place_m = length_m > 0.0 ? Vector3d(from_map_m + at / length_m * step_m) : from_map_m;
    const double here_m = at_m(place_m, against);
    nearest.clearance_m = std::min(nearest.clearance_m, here_m);
    if (here_m < enough_m) return {nearest.clearance_m, before_m};
    if (!(at < length_m)) return nearest;
    before_m = at;
    double skip_m = here_m - (enough_m > 0.0 ? enough_m : nearest.clearance_m) - off_m;
    if (half_height_cells_ && !plane_ && step_m.z() != 0.0) {
      const double next_z_m =
          (std::floor(place_m.z() / resolution_m_) + (step_m.z() > 0.0 ? 1.0 : 0.0)) * resolution_m_;
      skip_m = std::min(skip_m, (next_z_m - place_m.z()) / step_m.z() * length_m);
    }
    at = std::min(length_m, at + std::max(half_cell_m, skip_m));
  }
}

Vector3d Clearance::min_map_m() const {
  const Vector3d corner(begin_.x, plane_ ? begin_.z : begin_.y, plane_ ? 0 : begin_.z);
  return (corner + Vector3d::Constant(margin_cells())) * resolution_m_;
}

Vector3d Clearance::max_map_m() const {
  const Vector3d corner(end_.x, plane_ ? end_.z : end_.y, plane_ ? 0 : end_.z);
  return (corner - Vector3d::Constant(margin_cells())) * resolution_m_;
}

}  // namespace swiftlet::planning
