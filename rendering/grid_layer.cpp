#include "rendering/grid_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace swiftlet::rendering {
namespace {

/// How pixels along one axis cover cells. Pixel i has the taps [first[i], first[i + 1]). The weights of a pixel sum to
/// 256.
struct Taps {
  struct Tap {
    int cell;
    int weight;
  };
  std::vector<int> first;
  std::vector<Tap> taps;
};

/// `start` and `step` in cells: pixel i covers [start + i * step, start + (i + 1) * step); step may be negative.
Taps tapsOf(double start, double step, int begin_px, int end_px) {
  Taps result;
  for (int i = begin_px; i < end_px; ++i) {
    result.first.push_back(static_cast<int>(result.taps.size()));
    const double low = start + (step > 0.0 ? i : i + 1) * step;
    const double size = std::abs(step);
    int used = 0;
    for (int cell = static_cast<int>(std::floor(low)); used < 256; ++cell) {
      const double covered = std::min(1.0, (cell + 1 - low) / size);
      const int upto = static_cast<int>(std::lround(256.0 * covered));
      if (upto > used) result.taps.push_back({cell, upto - used});
      used = std::max(used, upto);
    }
  }
  result.first.push_back(static_cast<int>(result.taps.size()));
  return result;
}

// Three channels in one 64-bit number, 21 bits each. The first pass sums 8-bit values with 8-bit weights and keeps 13
// bits, the second goes from 13 to 21 bits, so no lane overflows.
constexpr std::uint64_t lanes(std::uint64_t value) { return value << 42 | value << 21 | value; }

std::uint64_t packed(Color c) {
  return static_cast<std::uint64_t>(c.red) << 42 | static_cast<std::uint64_t>(c.green) << 21 | c.blue;
}

class RowCache {
 public:
  RowCache(const common::OccupancyGrid& grid, const Theme& theme, int begin, int end)
      : grid_(grid), begin_(begin), end_(end) {
    const auto colors = cellColors(theme);
    std::transform(colors.begin(), colors.end(), colors_.begin(), packed);
  }

  /// The colours of a row of cells, from column `begin` on. Valid until two other rows are requested.
  const std::uint64_t* row(int y) {
    for (const Row& row : rows_)
      if (row.y == y && !row.colors.empty()) return row.colors.data();
    next_ = 1 - next_;
    fill(rows_[next_], y);
    return rows_[next_].colors.data();
  }

 private:
  struct Row {
    int y = 0;
    std::vector<std::uint64_t> colors;
  };

  void fill(Row& row, int y) {
    row.y = y;
    row.colors.assign(static_cast<std::size_t>(end_ - begin_), colors_[grid_.background() + 128]);
    constexpr int kTile = common::OccupancyGrid::kTileSize;
    for (int x = begin_; x < end_;) {
      const int tile_end = std::min(end_, (x & ~(kTile - 1)) + kTile);
      if (grid_.tileIdentity({x, y}) != nullptr)
        for (; x < tile_end; ++x) row.colors[static_cast<std::size_t>(x - begin_)] = colors_[grid_.at({x, y}) + 128];
      x = tile_end;
    }
  }

  const common::OccupancyGrid& grid_;
  int begin_, end_;
  std::array<std::uint64_t, 256> colors_{};
  std::array<Row, 2> rows_;
  int next_ = 0;
};

}  // namespace

std::array<Color, 256> cellColors(const Theme& theme) {
  std::array<Color, 256> colors{};
  for (int i = 0; i < 256; ++i) {
    const auto cell = static_cast<common::occupancy::Cell>(i - 128);
    const double p = common::occupancy::probability(cell);
    // A cell seen once already looks free or occupied; a certain one looks slightly more so. A free one always has a
    // contrast of 3:1 with the unknown.
    const auto weight = [](double least, double certainty) {
      return static_cast<int>(std::lround(255 * (least + (1.0 - least) * certainty)));
    };
    colors[static_cast<std::size_t>(i)] = common::occupancy::isUnknown(cell) ? theme.unknown
                                          : p <= 0.5 ? mix(theme.unknown, theme.free, weight(0.94, 1.0 - 2.0 * p))
                                                     : mix(theme.unknown, theme.wall, weight(0.55, 2.0 * p - 1.0));
  }
  return colors;
}

void drawGrid(const common::OccupancyGrid& grid, const Viewport& viewport, const Theme& theme, const PixelRect& rect,
              common::Image& image) {
  if (rect.empty()) return;
  const double cells_per_px = 1.0 / (viewport.px_per_m * grid.resolution_m());
  const Eigen::Vector2d corner = viewport.toMap({0.0, 0.0}) / grid.resolution_m();
  const Taps columns = tapsOf(corner.x(), cells_per_px, rect.x0, rect.x1);
  const Taps rows = tapsOf(corner.y(), -cells_per_px, rect.y0, rect.y1);
  const int begin = columns.taps.front().cell, end = columns.taps.back().cell + 1;
  RowCache cache(grid, theme, begin, end);

  std::vector<std::uint64_t> mean(static_cast<std::size_t>(end - begin));
  for (int y = rect.y0; y < rect.y1; ++y) {
    std::fill(mean.begin(), mean.end(), lanes(4));
    for (int t = rows.first[y - rect.y0]; t < rows.first[y - rect.y0 + 1]; ++t) {
      const std::uint64_t* row = cache.row(rows.taps[t].cell);
      const auto weight = static_cast<std::uint64_t>(rows.taps[t].weight);
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += weight * row[i];
    }
    for (std::uint64_t& value : mean) value = value >> 3 & lanes(0x1fff);

    std::uint8_t* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width_px + rect.x0)];
    for (int x = 0; x < rect.x1 - rect.x0; ++x, pixel += 3) {
      std::uint64_t sum = lanes(1 << 12);
      for (int t = columns.first[x]; t < columns.first[x + 1]; ++t)
        sum += static_cast<std::uint64_t>(columns.taps[t].weight) * mean[columns.taps[t].cell - begin];
      pixel[0] = static_cast<std::uint8_t>(sum >> 55);
      pixel[1] = static_cast<std::uint8_t>(sum >> 34);
      pixel[2] = static_cast<std::uint8_t>(sum >> 13);
    }
  }
}

PixelRect pixelsOf(const common::CellRect& cells, double resolution_m, const Viewport& viewport) {
  const Eigen::Vector2d low = viewport.toPixel(Eigen::Vector2d(cells.begin.x, cells.end.y) * resolution_m);
  const Eigen::Vector2d high = viewport.toPixel(Eigen::Vector2d(cells.end.x, cells.begin.y) * resolution_m);
  const auto clip = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {clip(std::floor(low.x()) - 1.0, viewport.width_px), clip(std::floor(low.y()) - 1.0, viewport.height_px),
          clip(std::ceil(high.x()) + 1.0, viewport.width_px), clip(std::ceil(high.y()) + 1.0, viewport.height_px)};
}

}  // namespace swiftlet::rendering
