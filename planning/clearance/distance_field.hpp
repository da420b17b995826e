// How far each cell of a box is from the nearest occupied one, exact up to a reach, and repaired where cells change.
//
//   occupied cells --> distance along z --> squared distance over y --> over x
//
// Each pass takes the least of value + offset squared over the offsets within reach (Saito and Toriwaki 1994;
// Felzenszwalb and Huttenlocher 2012), a row of 32 cells at a time. A tile is computed again only if a changed cell is
// not farther from it than its own greatest distance: no other change can raise or lower a distance in it (the wave of
// Lau, Sprunk and Burgard 2013, section 3, by tiles instead of cells).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/voxel_map.hpp"

namespace swiftlet::planning {

/// Half-open: begin <= cell < end along each axis.
struct CellBox {
  common::VoxelIndex begin, end;
  bool empty() const { return begin.x >= end.x || begin.y >= end.y || begin.z >= end.z; }
  bool operator==(const CellBox&) const = default;
};

/// A value. A copy shares all tiles, which are never written to once made: a copy costs O(tiles), and two threads may
/// use two copies. Cells count from 0; a plane is a box with one cell along y.
class DistanceField {
 public:
  static constexpr int kRow = 32;         ///< Cells of a tile along x.
  static constexpr int kMostReach = 127;  ///< Twice its square still fits into 16 bits.

  /// An empty box.
  DistanceField() = default;
  /// A box in which no cell is occupied. Its sides, greater than 0, are rounded up to whole tiles. `reach_cells` in
  /// [1, kMostReach]. With `half_height_cells`, distances are those of upright cylinders with that half height: cells
  /// at most so far above or below count as if they were at the same height, and others do not count.
  DistanceField(common::VoxelIndex size, int reach_cells, std::optional<int> half_height_cells = std::nullopt);

  /// Writes, for the kRow cells of a row from (x, y, z) on, 1 for an occupied cell and 0 for another. A row may reach
  /// beyond the size that was asked for.
  using RowReader = std::function<void(common::VoxelIndex first, std::span<std::uint8_t, kRow> occupied)>;

  /// Reads the cells of the boxes again and repairs the distances. Returns the boxes, one a tile, in which one changed.
  /// The result always equals that of a fresh field.
  std::vector<CellBox> update(std::span<const CellBox> boxes, const RowReader& read);

  /// The squared distance in cells from the centre of a cell to that of the nearest occupied one, at most beyond(). The
  /// cell must be in the box.
  int squared(common::VoxelIndex cell) const {
    return squares_[tileOf(cell)]->squares[static_cast<std::size_t>(offsetOf(cell))];
  }
  /// (reach + 1) squared: nothing is within reach.
  int beyond() const { return (reach_ + 1) * (reach_ + 1); }
  bool contains(common::VoxelIndex cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < size_.x && cell.y < size_.y && cell.z < size_.z;
  }
  /// In whole tiles.
  common::VoxelIndex size() const { return size_; }
  int reach_cells() const { return reach_; }

 private:
  static constexpr int kTileCells = 2048;
  static constexpr int kRowBits = 5;
  /// 0 in occupied cells, else the distance along z, at most reach + 1.
  using RunTile = std::array<std::uint8_t, kTileCells>;
  struct SquareTile {
    std::int16_t greatest = 0;
    std::array<std::int16_t, kTileCells> squares;
  };
  class Repair;

  std::size_t tileOf(common::VoxelIndex cell) const {
    return (static_cast<std::size_t>(cell.z >> z_bits_) * static_cast<std::size_t>(tiles_.y) +
            static_cast<std::size_t>(cell.y >> y_bits_)) *
               static_cast<std::size_t>(tiles_.x) +
           static_cast<std::size_t>(cell.x >> kRowBits);
  }
  int offsetOf(common::VoxelIndex cell) const {
    return (((cell.z & ((1 << z_bits_) - 1)) << y_bits_) + (cell.y & ((1 << y_bits_) - 1))) * kRow +
           (cell.x & (kRow - 1));
  }
  CellBox tileBox(int x, int y, int z) const;

  common::VoxelIndex size_, tiles_;
  int y_bits_ = 0, z_bits_ = 0;  ///< Of the sides of a tile.
  int reach_ = 0;
  std::optional<int> half_height_;
  std::vector<std::shared_ptr<const RunTile>> runs_;
  std::vector<std::shared_ptr<const SquareTile>> squares_;
  std::shared_ptr<const SquareTile> far_;  ///< The one tile of all places with nothing within reach.
};

}  // namespace swiftlet::planning
