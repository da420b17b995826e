#include "planning/costs/distance_transform.hpp"

#include <algorithm>
#include <array>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

constexpr int kTileCells = common::OccupancyGrid::kTileSize;
constexpr int kMaxWidth = kTileCells + 2 * kMaxReachCells;
using Row = std::array<std::int16_t, kMaxWidth>;
using Block = std::array<Row, kTileCells>;

/// One step of the column pass. `run` is the distance to the last cell of the state in each column.
bool advance(const CellStates& states, int y, int x_begin, int x_end, int x_first, CellState which, std::int16_t cap,
             Row& run) {
  bool met = false;
  const CellState* row = states.all().data() + static_cast<std::size_t>(y) * states.rect().width();
  for (int x = x_begin; x < x_end; ++x) {
    std::int16_t& distance = run[static_cast<std::size_t>(x - x_first)];
    const bool is = row[x] == which;
    met |= is;
    distance = is ? std::int16_t{0} : std::min(static_cast<std::int16_t>(distance + 1), cap);
  }
  return met;
}

/// The distance within each column, cut at reach + 1. False if the state does not occur near the tile.
bool columnPass(const CellStates& states, int x0, int y0, CellState which, int reach, Block& columns) {
  const auto cap = static_cast<std::int16_t>(reach + 1);
  const int x_first = x0 - reach, x_begin = std::max(0, x_first),
            x_end = std::min(states.rect().width(), x0 + kTileCells + reach);
  bool met = false;
  Row run;
  run.fill(cap);
  for (Row& row : columns) row.fill(cap);
  for (int y = std::max(0, y0 - reach); y < y0 + kTileCells; ++y) {
    met |= advance(states, y, x_begin, x_end, x_first, which, cap, run);
    if (y >= y0) columns[static_cast<std::size_t>(y - y0)] = run;
  }
  run.fill(cap);
  for (int y = std::min(states.rect().height(), y0 + kTileCells + reach) - 1; y >= y0; --y) {
    met |= advance(states, y, x_begin, x_end, x_first, which, cap, run);
    if (y >= y0 + kTileCells) continue;
    Row& row = columns[static_cast<std::size_t>(y - y0)];
    for (std::size_t i = 0; i < run.size(); ++i) row[i] = std::min(row[i], run[i]);
  }
  return met;
}

}  // namespace

void tileDistances(const CellStates& states, int x0, int y0, CellState which, int reach,
                   std::vector<std::int16_t>& squared) {
  SWIFTLET_CHECK(reach >= 0 && reach <= kMaxReachCells, reach);
  const auto beyond = static_cast<std::int16_t>((reach + 1) * (reach + 1));
  Block columns;
  const bool met = columnPass(states, x0, y0, which, reach, columns);
  for (int y = 0; y < kTileCells; ++y) {
    std::int16_t* out = squared.data() + static_cast<std::size_t>(y0 + y) * states.rect().width() + x0;
    std::fill_n(out, kTileCells, beyond);
    if (!met) continue;
    Row& row = columns[static_cast<std::size_t>(y)];
    for (std::int16_t& d : row) d = static_cast<std::int16_t>(d * d);
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto across = static_cast<std::int16_t>(dx * dx);
      const std::int16_t* in = row.data() + reach + dx;
      for (int x = 0; x < kTileCells; ++x) out[x] = std::min(out[x], static_cast<std::int16_t>(in[x] + across));
    }
  }
}

}  // namespace swiftlet::planning
