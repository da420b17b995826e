// A 2D grid that grows in all directions. A copy takes O(tiles): copies share their tiles until one of them writes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

/// A cell by column (x) and row (y); cell (0, 0) has its lower left corner at the origin of the grid's frame.
struct CellIndex {
  int x = 0;
  int y = 0;
  auto operator<=>(const CellIndex&) const = default;
};

/// A half-open rectangle of cells: begin <= cell < end.
struct CellRect {
  CellIndex begin;
  CellIndex end;
  int width() const { return end.x - begin.x; }
  int height() const { return end.y - begin.y; }
  bool empty() const { return width() <= 0 || height() <= 0; }
  bool contains(CellIndex c) const { return c.x >= begin.x && c.y >= begin.y && c.x < end.x && c.y < end.y; }
  bool operator==(const CellRect&) const = default;
};

/// A grid of values of type Cell. The cell size is fixed; the extent grows by whole tiles when a cell outside it is
/// written. Reading outside gives the background. `snapshot()` returns a copy that shares all tiles; afterwards a write
/// to either grid first clones the tile it changes. Two threads may use two copies; one copy belongs to one thread at a
/// time.
template <typename Cell>
class TiledGrid {
 public:
  static constexpr int kTileSize = 64;

  explicit TiledGrid(double resolution_m, Cell background = Cell{})
      : resolution_m_(resolution_m), background_(background) {}

  double resolution_m() const { return resolution_m_; }
  Cell background() const { return background_; }

  CellIndex cellAt(double x_m, double y_m) const {
    return {static_cast<int>(std::floor(x_m / resolution_m_)), static_cast<int>(std::floor(y_m / resolution_m_))};
  }
  CellIndex cellAt(const Eigen::Vector2d& point_m) const { return cellAt(point_m.x(), point_m.y()); }
  Eigen::Vector2d centerOf(CellIndex c) const { return {(c.x + 0.5) * resolution_m_, (c.y + 0.5) * resolution_m_}; }

  /// The allocated rectangle, in cells; a multiple of the tile size. Everything outside is background.
  CellRect extent() const {
    return {{tiles_begin_.x * kTileSize, tiles_begin_.y * kTileSize},
            {(tiles_begin_.x + columns_) * kTileSize, (tiles_begin_.y + rows_) * kTileSize}};
  }

  Cell at(CellIndex c) const {
    const int column = tileOf(c.x) - tiles_begin_.x, row = tileOf(c.y) - tiles_begin_.y;
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return background_;
    const auto& tile = slots_[static_cast<std::size_t>(row) * columns_ + column].tile;
    return tile ? (*tile)[offsetOf(c)] : background_;
  }

  void set(CellIndex c, Cell value) { mutableAt(c) = value; }

  /// A reference for writing; allocates or clones the tile. Valid until the next call that writes or grows.
  Cell& mutableAt(CellIndex c) {
    const int tile_x = tileOf(c.x), tile_y = tileOf(c.y);
    growTo(tile_x, tile_y);
    Slot& slot = slots_[static_cast<std::size_t>(tile_y - tiles_begin_.y) * columns_ + (tile_x - tiles_begin_.x)];
    if (!slot.tile) {
      slot.tile = std::make_shared<Tile>();
      slot.tile->fill(background_);
      slot.shared = false;
    } else if (slot.shared) {
      slot.tile = std::make_shared<Tile>(*slot.tile);
      slot.shared = false;
    }
    return (*slot.tile)[offsetOf(c)];
  }

  /// A copy that shares every tile; O(number of tiles).
  TiledGrid snapshot() {
    for (Slot& slot : slots_) slot.shared = true;
    return *this;
  }

  /// The identity of the tile that holds the cell: equal pointers in two snapshots mean equal content.
  const void* tileIdentity(CellIndex c) const {
    const int column = tileOf(c.x) - tiles_begin_.x, row = tileOf(c.y) - tiles_begin_.y;
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
    return slots_[static_cast<std::size_t>(row) * columns_ + column].tile.get();
  }

  /// Calls visit(CellIndex, Cell) for every cell of every allocated tile, tile by tile.
  template <typename Visitor>
  void forEachCell(Visitor&& visit) const {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto& tile = slots_[static_cast<std::size_t>(row) * columns_ + column].tile;
        if (!tile) continue;
        const int x0 = (tiles_begin_.x + column) * kTileSize, y0 = (tiles_begin_.y + row) * kTileSize;
        for (int i = 0; i < kTileSize * kTileSize; ++i)
          visit(CellIndex{x0 + i % kTileSize, y0 + i / kTileSize}, (*tile)[static_cast<std::size_t>(i)]);
      }
    }
  }

 private:
  using Tile = std::array<Cell, static_cast<std::size_t>(kTileSize) * kTileSize>;
  /// `shared` means that another grid may hold the same tile, which must then be cloned before writing. Only snapshot()
  /// sets it. It is not derived from use_count(), because other threads change that.
  struct Slot {
    std::shared_ptr<Tile> tile;
    bool shared = false;
  };

  static int tileOf(int cell) { return cell >= 0 ? cell / kTileSize : -((-cell + kTileSize - 1) / kTileSize); }
  static std::size_t offsetOf(CellIndex c) {
    return static_cast<std::size_t>(c.y & (kTileSize - 1)) * kTileSize +
           static_cast<std::size_t>(c.x & (kTileSize - 1));
  }

  void growTo(int tile_x, int tile_y) {
    if (columns_ > 0 && tile_x >= tiles_begin_.x && tile_y >= tiles_begin_.y && tile_x < tiles_begin_.x + columns_ &&
        tile_y < tiles_begin_.y + rows_)
      return;
    const CellIndex begin = columns_ == 0
                                ? CellIndex{tile_x, tile_y}
                                : CellIndex{std::min(tiles_begin_.x, tile_x), std::min(tiles_begin_.y, tile_y)};
    const CellIndex end = columns_ == 0 ? CellIndex{tile_x + 1, tile_y + 1}
                                        : CellIndex{std::max(tiles_begin_.x + columns_, tile_x + 1),
                                                    std::max(tiles_begin_.y + rows_, tile_y + 1)};
    const int columns = end.x - begin.x, rows = end.y - begin.y;
    std::vector<Slot> slots(static_cast<std::size_t>(columns) * rows);
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        slots[static_cast<std::size_t>(row + tiles_begin_.y - begin.y) * columns +
              (column + tiles_begin_.x - begin.x)] =
            std::move(slots_[static_cast<std::size_t>(row) * columns_ + column]);
    slots_ = std::move(slots);
    tiles_begin_ = begin;
    columns_ = columns;
    rows_ = rows;
  }

  double resolution_m_;
  Cell background_;
  CellIndex tiles_begin_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Slot> slots_;
};

}  // namespace swiftlet::common
