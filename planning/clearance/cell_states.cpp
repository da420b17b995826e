#include "planning/clearance/cell_states.hpp"

#include <algorithm>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;
using common::OccupancyGrid;
/// Unknown slivers up to this width between free cells count as free.
constexpr double kUnknownGap_m = 0.10;

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

std::vector<CellRect> CellStates::update(const OccupancyGrid& grid) {
  SWIFTLET_CHECK(grid.resolution_m() == grid_.resolution_m(), grid.resolution_m(), grid_.resolution_m());
  const CellRect tiles = grid.extent();
  const CellRect rect = tiles.empty() ? CellRect{}
                                      : CellRect{{tiles.begin.x - kTile, tiles.begin.y - kTile},
                                                 {tiles.end.x + kTile, tiles.end.y + kTile}};
  const bool all = rect != rect_;
  if (all) {
    rect_ = rect;
    const auto cells = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    raw_.assign(cells, CellState::kUnknown);
    closed_.assign(cells, CellState::kUnknown);
  }
  std::vector<CellRect> changes = closeSlivers(readTiles(grid, all));
  grid_ = grid;
  return changes;
}

std::vector<CellRect> CellStates::readTiles(const OccupancyGrid& grid, bool all) {
  std::vector<CellRect> changes;
  for (int y0 = kTile; y0 < rect_.height() - kTile; y0 += kTile) {
    for (int x0 = kTile; x0 < rect_.width() - kTile; x0 += kTile) {
      const CellIndex corner{rect_.begin.x + x0, rect_.begin.y + y0};
      if (grid.tileIdentity(corner) == (all ? nullptr : grid_.tileIdentity(corner))) continue;
      BoundingBox box;
      for (int y = y0; y < y0 + kTile; ++y) {
        for (int x = x0; x < x0 + kTile; ++x) {
          const CellState state = stateOf(grid.at({rect_.begin.x + x, rect_.begin.y + y}));
          CellState& known = raw_[static_cast<std::size_t>(y) * rect_.width() + x];
          if (state == known) continue;
          known = state;
          box.add(x, y);
        }
      }
      if (!box.empty()) changes.push_back(box.rect);
    }
  }
  return changes;
}

std::vector<CellRect> CellStates::closeSlivers(const std::vector<CellRect>& changes) {
  const int gap = static_cast<int>(kUnknownGap_m / grid_.resolution_m() + 1e-6), stride = rect_.width();
  const CellRect whole{{0, 0}, {rect_.width(), rect_.height()}};
  const CellRect inside =
      dilated(whole, -(gap + 1), whole.empty() ? whole : CellRect{{-kTile, -kTile}, {INT32_MAX, INT32_MAX}});
  std::vector<CellRect> changed;
  for (const CellRect& raw : changes) {
    const CellRect r = dilated(raw, gap, inside);
    BoundingBox box;
    for (int y = r.begin.y; y < r.end.y; ++y) {
      for (int x = r.begin.x; x < r.end.x; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * stride + x;
        CellState state = raw_[i];
        if (state == CellState::kUnknown && gap > 0 && isSliver(&raw_[i], stride, gap)) state = CellState::kFree;
        if (state == closed_[i]) continue;
        closed_[i] = state;
        box.add(x, y);
      }
    }
    if (!box.empty()) changed.push_back(box.rect);
  }
  return changed;
}

}  // namespace swiftlet::planning
