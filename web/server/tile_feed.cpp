#include "web/server/tile_feed.hpp"

#include <bit>

#include "web/server/tile_codec.hpp"

namespace swiftlet::web {
namespace {

constexpr int kTileCells = common::OccupancyGrid::kTileSize;

void appendInteger(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255u);
}

std::string unknownTile() { return encodeTile(common::makeOccupancyGrid(1.0), {0, 0}); }

}  // namespace

void TileFeed::update(const std::shared_ptr<const common::OccupancyGrid>& grid) {
  if (grid == grid_) return;
  Tiles next;
  const common::CellRect extent = grid->extent();
  for (int y = extent.begin.y; y < extent.end.y; y += kTileCells)
    for (int x = extent.begin.x; x < extent.end.x; x += kTileCells) {
      const void* identity = grid->tileIdentity({x, y});
      if (identity == nullptr) continue;
      const common::CellIndex tile{x / kTileCells, y / kTileCells};
      const auto known = tiles_.find(tile);
      if (known != tiles_.end() && grid_ && grid_->tileIdentity({x, y}) == identity) {
        next.emplace(tile, known->second);
        continue;
      }
      std::string bytes = encodeTile(*grid, {x, y});
      next.emplace(tile, known != tiles_.end() && *known->second == bytes
                             ? known->second
                             : std::make_shared<const std::string>(std::move(bytes)));
    }
  tiles_ = std::move(next);
  grid_ = grid;
}

std::string TileReader::next(const TileFeed& feed, std::size_t most_bytes) {
  const bool forget = feed.resolution_m() != resolution_m_;
  if (forget) has_.clear();
  resolution_m_ = feed.resolution_m();
  std::string tiles;
  std::uint32_t count = 0;
  const auto add = [&](common::CellIndex tile, const std::string& bytes) {
    appendInteger(tiles, static_cast<std::uint32_t>(tile.x), 2);
    appendInteger(tiles, static_cast<std::uint32_t>(tile.y), 2);
    appendInteger(tiles, static_cast<std::uint32_t>(bytes.size()), 2);
    tiles += bytes;
    ++count;
  };
  for (const auto& [tile, bytes] : feed.tiles()) {
    SharedText& has = has_[tile];
    if (has == bytes || tiles.size() >= most_bytes) continue;
    has = bytes;
    add(tile, *bytes);
  }
  for (auto it = has_.begin(); it != has_.end() && tiles.size() < most_bytes;) {
    if (feed.tiles().contains(it->first)) {
      ++it;
      continue;
    }
    add(it->first, unknownTile());
    it = has_.erase(it);
  }
  if (count == 0 && !forget) return {};
  std::string message;
  appendInteger(message, static_cast<std::uint32_t>(map_), 1);
  appendInteger(message, forget ? 1 : 0, 1);
  appendInteger(message, count, 2);
  appendInteger(message, std::bit_cast<std::uint32_t>(static_cast<float>(resolution_m_)), 4);
  return message + tiles;
}

}  // namespace swiftlet::web
