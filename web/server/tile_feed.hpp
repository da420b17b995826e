// The map for many pages. Each tile is encoded once when it changes, and each page gets the tiles that differ from its
// own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::web {

using SharedText = std::shared_ptr<const std::string>;

class TileFeed {
 public:
  /// The encoded tile by its position in tiles. Equal pointers mean equal bytes.
  using Tiles = std::map<common::CellIndex, SharedText>;

  /// Encodes the tiles that differ from the last grid.
  void update(const std::shared_ptr<const common::OccupancyGrid>& grid);

  const Tiles& tiles() const { return tiles_; }
  double resolution_m() const { return grid_ ? grid_->resolution_m() : 0.0; }

 private:
  std::shared_ptr<const common::OccupancyGrid> grid_;  ///< Kept alive, so that tile addresses stay unique.
  Tiles tiles_;
};

/// The tiles that one page has.
class TileReader {
 public:
  enum class Map : std::uint8_t { kFlown = 1, kGiven = 3 };
  explicit TileReader(Map map) : map_(map) {}

  /// The next message of at most about `most_bytes`, or an empty text when the page has everything. Little endian:
  /// u8 the map, u8 forget everything first, u16 number of tiles, f32 resolution_m, then for each tile i16 x, i16 y (in
  /// tiles), u16 length, bytes.
  std::string next(const TileFeed& feed, std::size_t most_bytes);

 private:
  Map map_;
  TileFeed::Tiles has_;
  double resolution_m_ = 0.0;
};

}  // namespace swiftlet::web
