// Remembers obstacles that end below the beams: a table, a counter, the back of a chair. Only a tilted beam meets them,
// for a fraction of a second each time, and level beams pass above them in between. The height of a beam is known to
// some 2 % of its range, so that beams which pass just above seem to go through, and would erase the obstacle. What
// beams hit, pass above, and hit again in the same place is kept, the longer the more often it was hit. People are
// not: they reach as high as the beams.
#pragma once

#include <cstdint>
#include <optional>

#include "common/tiled_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::perception {

/// Heights are numbers of slices. Not thread-safe; a snapshot may go to another thread.
class LowObstacles {
 public:
  explicit LowObstacles(double resolution_m) : cells_(resolution_m) {}

  /// A beam ended in the cell at that height, below that of the laser. Returns true if top() of the cell has changed.
  bool hit(common::CellIndex cell, int slice, common::Time now);
  /// A beam ended in the cell at the height of the laser. After some of them, earlier hits there belong to something
  /// that reaches up, unless it is certain.
  void reachesUp(common::CellIndex cell);
  /// A beam crossed the cell at that height. Returns true if top() of the cell has changed.
  bool passed(common::CellIndex cell, int slice, common::Time now);
  /// What was in the cell has gone.
  void forget(common::CellIndex cell);

  /// The height up to which something certainly stands in the cell.
  std::optional<int> top(common::CellIndex cell) const;
  /// Calls visit(cell, top) for every cell in which something certainly stands.
  template <typename Visitor>
  void forEach(Visitor&& visit) const {
    cells_.forEachCell([&](common::CellIndex index, const Cell& cell) {
      if (isCertain(cell)) visit(index, static_cast<int>(cell.top));
    });
  }

  LowObstacles snapshot() {
    cells_ = cells_.snapshot();
    return *this;
  }

 private:
  struct Cell {
    common::Time met;            ///< When a beam last ended here.
    std::int16_t top = 0;        ///< The highest slice that a beam ended in.
    std::uint8_t sightings = 0;  ///< Times that it was met, with beams that passed above it in between.
    std::uint8_t level = 0;      ///< Beams that ended here at the height of the laser since others passed above.
    bool passed = false;         ///< Beams have passed above it since it was met.
  };
  static bool isCertain(const Cell& cell);

  common::TiledGrid<Cell> cells_;
};

}  // namespace swiftlet::perception
