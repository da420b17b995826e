#include "web/server/tile_codec.hpp"

namespace swiftlet::web {
namespace {

constexpr int kTile = common::OccupancyGrid::kTileSize;
/// A run of this or more has its length in the bytes that follow; the low half of a byte holds the shorter ones.
constexpr int kLongRun = 15;

void append(std::string& bytes, int shade, int length) {
  const int n = length - 1;
  if (n < kLongRun) {
    bytes += static_cast<char>(shade << 4 | n);
  } else {
    bytes += static_cast<char>(shade << 4 | kLongRun);
    bytes += static_cast<char>(n & 255);
    bytes += static_cast<char>(n >> 8);
  }
}

}  // namespace

int shadeOf(common::occupancy::Cell cell) {
  if (common::occupancy::isUnknown(cell)) return 0;
  // Log odds that stand for 73 %, 92 % and 99 % confidence.
  const int certainty = cell < 0 ? -cell : cell;
  const int sure = certainty >= 92 ? 3 : certainty >= 50 ? 2 : certainty >= 20 ? 1 : 0;
  return common::occupancy::isOccupied(cell) ? 5 + sure : 4 - sure;
}

std::string encodeTile(const common::OccupancyGrid& grid, common::CellIndex corner) {
  std::string bytes;
  int shade = -1, length = 0;
  for (int y = corner.y; y < corner.y + kTile; ++y)
    for (int x = corner.x; x < corner.x + kTile; ++x) {
      const int next = shadeOf(grid.at({x, y}));
      if (next != shade && length > 0) {
        append(bytes, shade, length);
        length = 0;
      }
      shade = next;
      ++length;
    }
  append(bytes, shade, length);
  return bytes;
}

}  // namespace swiftlet::web
