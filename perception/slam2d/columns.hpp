// Remembers at which heights beams ended in each cell of the map, and for how long beams have passed there since. What
// has gone is free at all of its heights, however long it was there: it could not have been passed.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::perception {

/// A place of the map from which something has gone: beams at that height, over the take-off floor, have passed it for
/// long enough.
struct GoneColumn {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  double height_m = 0.0;
};

/// Heights are numbers of slices. Not thread-safe; a snapshot may go to another thread.
class Columns {
 public:
  /// Beams of one scan that passed a cell, and would have hit what is there between the two heights.
  struct Pass {
    std::uint16_t scan = 0;  ///< Its number; a scan counts once.
    int lowest = 0, highest = 0;
    common::Duration lasts;  ///< The time for which the scan stands.
  };
  /// From bottom to top; up to `surely` it reaches whatever the errors of heights were.
  struct Extent {
    int bottom = 0, top = -1, surely = INT16_MIN;
  };

  explicit Columns(double resolution_m) : cells_(resolution_m) {}

  /// Beams ended in the cell at heights from `met.bottom` to `met.top`. Something reaches as far up or down as two ends
  /// do: one alone may be noise of a height or a range.
  void ended(common::CellIndex cell, const Extent& met);
  /// Greatest Extent::surely and Extent::top of the cell and those around it; INT16_MIN where nothing stands.
  int surelyAround(common::CellIndex cell) const;
  int topAround(common::CellIndex cell) const;
  /// Returns where something was, if that has gone now: it has been passed for long enough since a beam last ended.
  std::optional<Extent> passed(common::CellIndex cell, const Pass& pass);
  /// Forgets what stands in the cell and returns where that was, if it is lower than `top`.
  std::optional<Extent> takeBelow(common::CellIndex cell, int top);
  /// Nothing stands in the cell any more.
  void forget(common::CellIndex cell) {
    if (cells_.at(cell) != Cell{}) cells_.set(cell, {});
  }

  Columns snapshot() {
    cells_ = cells_.snapshot();
    return *this;
  }

 private:
  struct Cell {
    std::int16_t bottom = 0, top = -1, surely = INT16_MIN;
    std::int16_t lowest = INT16_MAX, highest = INT16_MIN, surest = INT16_MIN;  ///< Of all ends.
    std::uint16_t passed_ms = 0;
    std::uint16_t scan = 0;  ///< That was counted last.
    bool operator==(const Cell&) const = default;
  };
  common::TiledGrid<Cell> cells_;
};

}  // namespace swiftlet::perception
