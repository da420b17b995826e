#include "planning/costs/cost_map.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "planning/costs/distance_transform.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;
using common::OccupancyGrid;
constexpr int kTile = OccupancyGrid::kTileSize;

CellState stateOf(common::occupancy::Cell cell) {
  if (common::occupancy::isUnknown(cell)) return CellState::kUnknown;
  return common::occupancy::isOccupied(cell) ? CellState::kOccupied : CellState::kFree;
}

CellRect dilated(const CellRect& r, int by, const CellRect& within) {
  return {{std::max(r.begin.x - by, within.begin.x), std::max(r.begin.y - by, within.begin.y)},
          {std::min(r.end.x + by, within.end.x), std::min(r.end.y + by, within.end.y)}};
}

/// Grows to include the cells that are added; empty at first.
struct BoundingBox {
  CellRect rect{{INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN}};
  void add(int x, int y) {
    rect.begin = {std::min(rect.begin.x, x), std::min(rect.begin.y, y)};
    rect.end = {std::max(rect.end.x, x + 1), std::max(rect.end.y, y + 1)};
  }
  bool empty() const { return rect.begin.x == INT32_MAX; }
};

/// Unknown cells in a row, at most `gap` long in one of four directions, with free cells at both ends.
bool isSliver(const CellState* cell, std::ptrdiff_t stride, int gap) {
  for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, stride, stride + 1, stride - 1}) {
    int ahead = 1;
    while (ahead <= gap && cell[ahead * step] == CellState::kUnknown) ++ahead;
    if (ahead > gap || cell[ahead * step] != CellState::kFree) continue;
    int behind = 1;
    while (ahead + behind - 1 <= gap && cell[-behind * step] == CellState::kUnknown) ++behind;
    if (ahead + behind - 1 <= gap && cell[-behind * step] == CellState::kFree) return true;
  }
  return false;
}

}  // namespace

/// Rectangles of the dense array (its own coordinates, from 0) whose content changed.
struct CostMap::Changes {
  std::vector<CellRect> rects;
};

void CostMap::Config::describe(common::config::Fields& fields) {
  fields("comfort_weight", comfort_weight, {0, 50},
         "A metre at the clearance costs (1 + this) times as much as a metre in the open.");
}

CostMap::CostMap(const Config& config, double resolution_m)
    : config_(config), grid_(common::makeOccupancyGrid(resolution_m)) {}

double CostMap::obstacleDistance_m(CellIndex c) const {
  if (!contains(c)) return reach_m();
  const int squared = occupied_distance2_[static_cast<std::size_t>(indexOf(c))];
  return std::min(std::sqrt(squared) * resolution_m(), reach_m());
}

void CostMap::update(const OccupancyGrid& grid, const Footprint& footprint, const CostLayers& layers) {
  SWIFTLET_CHECK(grid.resolution_m() == resolution_m(), grid.resolution_m(), resolution_m());
  const bool moved =
      footprint.hull_radius_m != footprint_.hull_radius_m || footprint.clearance_m != footprint_.clearance_m;
  const CellRect tiles = grid.extent();
  const CellRect rect = tiles.empty() ? CellRect{}
                                      : CellRect{{tiles.begin.x - kTile, tiles.begin.y - kTile},
                                                 {tiles.end.x + kTile, tiles.end.y + kTile}};
  const bool all = moved || rect != rect_;
  if (all) reshape(rect, footprint);

  Changes changes;
  readTiles(grid, all, changes);
  closeSlivers(changes);
  updateDistances(changes, all);
  applyLayers(layers);
  grid_ = grid;
}

void CostMap::reshape(const CellRect& rect, const Footprint& footprint) {
  footprint_ = footprint;
  rect_ = rect;
  const auto cellsFor = [&](double m) {
    return std::clamp(static_cast<int>(std::ceil(m / resolution_m())), 0, kMaxReachCells);
  };
  reach_cells_ = cellsFor(footprint.radius_m() + config_.comfort_distance_m);
  unknown_reach_cells_ = cellsFor(footprint.hull_radius_m);

  const auto cells = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  raw_.assign(cells, CellState::kUnknown);
  state_.assign(cells, CellState::kUnknown);
  occupied_distance2_.assign(cells, 0);
  unknown_distance2_.assign(cells, 0);
  static_cost_.assign(cells, kLethal);
  cost_.assign(cells, kLethal);

  margin_cost_.resize(static_cast<std::size_t>((reach_cells_ + 1) * (reach_cells_ + 1)) + 1);
  for (std::size_t squared = 0; squared < margin_cost_.size(); ++squared)
    margin_cost_[squared] =
        costOfMargin(std::sqrt(static_cast<double>(squared)) * resolution_m() - footprint.radius_m());
}

CostMap::Cost CostMap::costOfMargin(double margin_m) const {
  if (margin_m < 0.0) return kLethal;
  const double reach_m = this->reach_m() - footprint_.radius_m();
  if (margin_m >= reach_m) return kOpenCost;
  const double nearness = 1.0 - margin_m / reach_m;
  return static_cast<Cost>(std::lround(kOpenCost * (1.0 + config_.comfort_weight * nearness * nearness)));
}

void CostMap::readTiles(const OccupancyGrid& grid, bool all, Changes& changes) {
  for (int y0 = kTile; y0 < rect_.height() - kTile; y0 += kTile) {
    for (int x0 = kTile; x0 < rect_.width() - kTile; x0 += kTile) {
      const CellIndex corner{rect_.begin.x + x0, rect_.begin.y + y0};
      if (!all && grid.tileIdentity(corner) == grid_.tileIdentity(corner)) continue;
      if (grid.tileIdentity(corner) == nullptr && all) continue;
      BoundingBox box;
      for (int y = y0; y < y0 + kTile; ++y) {
        for (int x = x0; x < x0 + kTile; ++x) {
          const CellState state = stateOf(grid.at({rect_.begin.x + x, rect_.begin.y + y}));
          CellState& known = raw_[static_cast<std::size_t>(y) * stride() + x];
          if (state == known) continue;
          known = state;
          box.add(x, y);
        }
      }
      if (!box.empty()) changes.rects.push_back(box.rect);
    }
  }
}

void CostMap::closeSlivers(Changes& changes) {
  const int gap = static_cast<int>(config_.unknown_gap_m / resolution_m() + 1e-6);
  const CellRect whole{{0, 0}, {rect_.width(), rect_.height()}};
  const CellRect inside =
      dilated(whole, -(gap + 1), whole.empty() ? whole : CellRect{{-kTile, -kTile}, {INT32_MAX, INT32_MAX}});
  std::vector<CellRect> changed;
  for (const CellRect& raw : changes.rects) {
    const CellRect r = dilated(raw, gap, inside);
    BoundingBox box;
    for (int y = r.begin.y; y < r.end.y; ++y) {
      for (int x = r.begin.x; x < r.end.x; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * stride() + x;
        CellState state = raw_[i];
        if (state == CellState::kUnknown && gap > 0 && isSliver(&raw_[i], stride(), gap)) state = CellState::kFree;
        if (state == state_[i]) continue;
        state_[i] = state;
        box.add(x, y);
      }
    }
    if (!box.empty()) changed.push_back(box.rect);
  }
  changes.rects = std::move(changed);
}

void CostMap::updateDistances(const Changes& changes, bool all) {
  const int columns = rect_.width() / kTile, rows = rect_.height() / kTile;
  std::vector<bool> dirty(static_cast<std::size_t>(columns) * rows, all);
  const CellRect whole{{0, 0}, {rect_.width(), rect_.height()}};
  for (const CellRect& change : changes.rects) {
    const CellRect r = dilated(change, reach_cells_, whole);
    for (int row = r.begin.y / kTile; row <= (r.end.y - 1) / kTile; ++row)
      for (int column = r.begin.x / kTile; column <= (r.end.x - 1) / kTile; ++column)
        dirty[static_cast<std::size_t>(row) * columns + column] = true;
  }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      if (dirty[static_cast<std::size_t>(row) * columns + column]) costTile(column * kTile, row * kTile);
}

void CostMap::costTile(int x0, int y0) {
  const StateImage image{state_, rect_.width(), rect_.height()};
  tileDistances(image, x0, y0, CellState::kOccupied, reach_cells_, occupied_distance2_);
  tileDistances(image, x0, y0, CellState::kUnknown, unknown_reach_cells_, unknown_distance2_);
  const double unknown_radius = footprint_.hull_radius_m / resolution_m();
  for (int y = y0; y < y0 + kTile; ++y) {
    for (int x = x0; x < x0 + kTile; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * stride() + x;
      const bool blind = !config_.pass_unknown &&
                         (state_[i] == CellState::kUnknown || unknown_distance2_[i] < unknown_radius * unknown_radius);
      static_cost_[i] = blind ? kLethal : margin_cost_[static_cast<std::size_t>(occupied_distance2_[i])];
    }
  }
}

}  // namespace swiftlet::planning
