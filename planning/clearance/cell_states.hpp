// The states of a grid's cells, as clearance and costs read them: a dense array in which unknown slivers are closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::planning {

/// Unknown slivers between beams count as free.
enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A value: copy it to give a job a snapshot. Reading is safe from any thread while the object is not updated.
class CellStates {
 public:
  /// The rectangle is made of tiles of this side, in cells.
  static constexpr int kTile = common::OccupancyGrid::kTileSize;

  explicit CellStates(double resolution_m) : grid_(common::makeOccupancyGrid(resolution_m)) {}

  /// Reads the tiles whose identity is not that of the last call, and returns the rectangles in which a state changed,
  /// counted from the first cell of rect(). `grid` is a snapshot that is not written to any more, of the constructor's
  /// resolution; a copy of it (with shared tiles) is kept. The result always equals that of a fresh object.
  std::vector<common::CellRect> update(const common::OccupancyGrid& grid);

  /// The snapshot last read.
  const common::OccupancyGrid& grid() const { return grid_; }
  /// The extent of the grid and one tile of unknown margin around it; empty for an empty grid.
  const common::CellRect& rect() const { return rect_; }
  /// The indices run row by row.
  int indexOf(common::CellIndex c) const { return (c.y - rect_.begin.y) * rect_.width() + (c.x - rect_.begin.x); }
  CellState operator[](int index) const { return closed_[static_cast<std::size_t>(index)]; }
  /// Unknown outside the rectangle.
  CellState at(common::CellIndex c) const { return rect_.contains(c) ? (*this)[indexOf(c)] : CellState::kUnknown; }
  const std::vector<CellState>& all() const { return closed_; }

 private:
  std::vector<common::CellRect> readTiles(const common::OccupancyGrid& grid, bool all);
  std::vector<common::CellRect> closeSlivers(const std::vector<common::CellRect>& changes);

  common::OccupancyGrid grid_;  ///< Kept for the identity of its tiles.
  common::CellRect rect_;
  std::vector<CellState> raw_;     ///< States as in the grid.
  std::vector<CellState> closed_;  ///< States with the unknown slivers closed.
};

}  // namespace swiftlet::planning
