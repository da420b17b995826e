#include "perception/scan_matching/likelihood_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

/// Windows are read 16 bytes at a time; the last read may extend past the array.
constexpr std::size_t kOverread = 64;

int floorToMultiple(int value, int step) {
  const int remainder = value % step;
  return value - (remainder < 0 ? remainder + step : remainder);
}

/// Index of a cell in rows of `width`.
std::size_t indexOf(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// out = max(out, in) for 16 bytes.
void raiseRow(const std::uint8_t* in, std::uint8_t* out) {
#if defined(__x86_64__)
  const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(in));
  const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(out));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_max_epu8(a, b));
#else
  for (int c = 0; c < 16; ++c) out[c] = std::max(out[c], in[c]);
#endif
}

/// out[i] is the maximum of the nine cells of three rows from column 2 i on. `count` is at most kTile / 2 + 1.
void coarsen(const std::uint8_t* rows, std::ptrdiff_t stride, int count, std::uint8_t* out) {
  constexpr int kLane = 16;
  constexpr int kColumns = 5 * kLane;  // At least 2 (kTile / 2 + 1) + 1.
  alignas(kLane) std::array<std::uint8_t, kColumns + kLane> column_max{};
  alignas(kLane) std::array<std::uint8_t, std::size_t{3} * kLane> greatest;
  const int columns = 2 * count + 1;
#if defined(__x86_64__)
  const auto load = [](const std::uint8_t* at) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at)); };
  for (int x = 0; x < columns; x += kLane) {
    const std::uint8_t* in = rows + x;
    const __m128i top = _mm_max_epu8(_mm_max_epu8(load(in), load(in + stride)), load(in + 2 * stride));
    _mm_store_si128(reinterpret_cast<__m128i*>(&column_max[static_cast<std::size_t>(x)]), top);
  }
  const auto widest = [&](int x) {  // The maximum is in the lower byte of each pair.
    const std::uint8_t* in = &column_max[static_cast<std::size_t>(x)];
    const __m128i top = _mm_max_epu8(_mm_max_epu8(load(in), load(in + 1)), load(in + 2));
    return _mm_and_si128(top, _mm_set1_epi16(0xFF));
  };
  for (int x = 0; x < columns - 1; x += 2 * kLane)
    _mm_store_si128(reinterpret_cast<__m128i*>(&greatest[static_cast<std::size_t>(x / 2)]),
                    _mm_packus_epi16(widest(x), x + kLane < kColumns ? widest(x + kLane) : _mm_setzero_si128()));
#else
  for (int x = 0; x < columns; ++x)
    column_max[static_cast<std::size_t>(x)] = std::max({rows[x], rows[x + stride], rows[x + 2 * stride]});
  for (int i = 0; i < count; ++i) {
    const std::uint8_t* in = &column_max[static_cast<std::size_t>(2 * i)];
    greatest[static_cast<std::size_t>(i)] = std::max({in[0], in[1], in[2]});
  }
#endif
  std::memcpy(out, greatest.data(), static_cast<std::size_t>(count));
}

}  // namespace

LikelihoodField::LikelihoodField(double resolution_m, double sigma_m) : resolution_m_(resolution_m), sigma_m_(sigma_m) {
  SWIFTLET_CHECK(resolution_m > 0.0 && sigma_m > 0.0 && 3.0 * sigma_m <= (kMaxKernelCells + 1e-9) * resolution_m,
                 resolution_m, sigma_m);
  makeKernels();
}

void LikelihoodField::makeKernels() {
  const double reach_cells = reach_m() / resolution_m_;
  for (int sub_y = 0; sub_y < kSubcells; ++sub_y) {
    for (int sub_x = 0; sub_x < kSubcells; ++sub_x) {
      auto& kernel = kernels_[indexOf(sub_x, sub_y, kSubcells)];
      const double center_x = kMaxKernelCells + (sub_x + 0.5) / kSubcells;
      const double center_y = kMaxKernelCells + (sub_y + 0.5) / kSubcells;
      for (int y = 0; y < kKernelSize; ++y) {
        for (int x = 0; x < kKernelSize; ++x) {
          const double distance = std::hypot(x + 0.5 - center_x, y + 0.5 - center_y) / reach_cells;
          const double value = std::max(0.0, 255.0 * (1.0 - distance * distance));
          kernel[indexOf(x, y, kKernelSize)] = static_cast<std::uint8_t>(std::lround(value));
        }
      }
    }
  }
}

void LikelihoodField::clear() {
  const int tiles_x = width_ / kTile;
  for (const int tile : drawn_tiles_) {
    const int x0 = tile % tiles_x * kTile, y0 = tile / tiles_x * kTile;
    for (int k = 0; k <= prepared_top_; ++k) {
      // Starts one cell before the tile, because coarse cells there overlap it.
      const int begin_x = std::max((x0 >> k) - 1, 0), begin_y = std::max((y0 >> k) - 1, 0);
      const int end_x = (x0 + kTile) >> k, end_y = (y0 + kTile) >> k;
      for (int y = begin_y; y < end_y; ++y)
        std::memset(
            &levels_[static_cast<std::size_t>(k)][static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ >> k) +
                                                  static_cast<std::size_t>(begin_x)],
            0, static_cast<std::size_t>(end_x - begin_x));
    }
    tile_levels_[static_cast<std::size_t>(tile)] = 0;
  }
  drawn_tiles_.clear();
  drawn_ = false;
}

void LikelihoodField::draw(std::span<const ContourSegment> segments) {
  if (segments.empty()) return;
  double low_x = INFINITY, low_y = INFINITY, high_x = -INFINITY, high_y = -INFINITY;
  for (const ContourSegment& s : segments) {
    low_x = std::min({low_x, s.begin_m.x(), s.end_m.x()});
    low_y = std::min({low_y, s.begin_m.y(), s.end_m.y()});
    high_x = std::max({high_x, s.begin_m.x(), s.end_m.x()});
    high_y = std::max({high_y, s.begin_m.y(), s.end_m.y()});
  }
  const double scale = 1.0 / resolution_m_;
  const auto cell = [&](double value_m) { return static_cast<int>(std::floor(value_m * scale)); };
  const int margin = kMaxKernelCells + 1;
  reserve(cell(low_x) - margin, cell(low_y) - margin, cell(high_x) + margin, cell(high_y) + margin, border_);

  Eigen::Vector2d last(0.0, 0.0);
  bool stamped = false;
  for (const ContourSegment& s : segments) {
    const Eigen::Vector2d begin(s.begin_m.x() * scale - begin_x_, s.begin_m.y() * scale - begin_y_);
    const Eigen::Vector2d end(s.end_m.x() * scale - begin_x_, s.end_m.y() * scale - begin_y_);
    const int steps = static_cast<int>(std::ceil((end - begin).norm()));
    // A segment usually begins where the one before ended.
    if (!stamped || begin != last) stamp(begin.x(), begin.y());
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector2d at = begin + (end - begin) * (static_cast<double>(i) / steps);
      stamp(at.x(), at.y());
    }
    last = end;
    stamped = true;
  }
  drawn_ = true;
}

void LikelihoodField::stamp(double x_cells, double y_cells) {
  const int x = static_cast<int>(x_cells), y = static_cast<int>(y_cells);
  const int sub_x = static_cast<int>((x_cells - x) * kSubcells), sub_y = static_cast<int>((y_cells - y) * kSubcells);
  const auto& kernel = kernels_[indexOf(sub_x, sub_y, kSubcells)];
  const int x0 = x - kMaxKernelCells, y0 = y - kMaxKernelCells;
  std::uint8_t* out = &levels_[0][indexOf(x0, y0, width_)];
  const std::uint8_t* in = kernel.data();
  for (int row = 0; row < kKernelSize; ++row, out += width_, in += kKernelSize) raiseRow(in, out);

  const int tiles_x = width_ / kTile;
  const int tile_x0 = x0 / kTile, tile_x1 = (x0 + kKernelSize - 1) / kTile;
  const int tile_y0 = y0 / kTile, tile_y1 = (y0 + kKernelSize - 1) / kTile;
  for (int ty = tile_y0; ty <= tile_y1; ++ty)
    for (int tx = tile_x0; tx <= tile_x1; ++tx) markTile(ty * tiles_x + tx);
}

void LikelihoodField::markTile(int tile) {
  std::uint8_t& levels = tile_levels_[static_cast<std::size_t>(tile)];
  if (levels == 0) drawn_tiles_.push_back(tile);
  levels = 1;
}

void LikelihoodField::reserve(int min_x, int min_y, int max_x, int max_y, int border) {
  if (drawn_) {
    min_x = std::min(min_x, extent_.min_x);
    min_y = std::min(min_y, extent_.min_y);
    max_x = std::max(max_x, extent_.max_x);
    max_y = std::max(max_y, extent_.max_y);
  }
  extent_.min_x = min_x;
  extent_.min_y = min_y;
  extent_.max_x = max_x;
  extent_.max_y = max_y;
  border_ = std::max(border_, border);
  if (width_ > 0 && min_x - border_ >= begin_x_ && min_y - border_ >= begin_y_ && max_x + border_ < begin_x_ + width_ &&
      max_y + border_ < begin_y_ + height_)
    return;

  // Slack, so that the array does not grow with every scan of a moving vehicle.
  const int slack = 2 * kTile;
  const int begin_x = floorToMultiple(min_x - border_ - slack, kTile);
  const int begin_y = floorToMultiple(min_y - border_ - slack, kTile);
  const int width = floorToMultiple(max_x + border_ + slack, kTile) + kTile - begin_x;
  const int height = floorToMultiple(max_y + border_ + slack, kTile) + kTile - begin_y;
  // The cells are all zero, so the array can be placed anywhere.
  if (!drawn_ && width <= width_ && height <= height_) {
    begin_x_ = begin_x;
    begin_y_ = begin_y;
    return;
  }
  std::array<std::vector<std::uint8_t>, kLevels>& levels = spare_levels_;
  for (int k = 0; k < kLevels; ++k) {
    const std::size_t cells = static_cast<std::size_t>(width >> k) * static_cast<std::size_t>(height >> k) + kOverread;
    std::vector<std::uint8_t>& level = levels[static_cast<std::size_t>(k)];
    if (level.capacity() < cells) level.reserve(cells + cells / 4);
    level.assign(cells, 0);
  }
  std::vector<std::uint8_t> tile_levels(
      static_cast<std::size_t>(width / kTile) * static_cast<std::size_t>(height / kTile), 0);
  std::vector<int> drawn_tiles;
  for (const int tile : drawn_tiles_) {
    const int old_x = tile % (width_ / kTile) * kTile, old_y = tile / (width_ / kTile) * kTile;
    const int x = old_x + begin_x_ - begin_x, y = old_y + begin_y_ - begin_y;
    for (int row = 0; row < kTile; ++row)
      std::memcpy(&levels[0][indexOf(x, y + row, width)], &levels_[0][indexOf(old_x, old_y + row, width_)], kTile);
    const int new_tile = y / kTile * (width / kTile) + x / kTile;
    tile_levels[static_cast<std::size_t>(new_tile)] = 1;
    drawn_tiles.push_back(new_tile);
  }
  std::swap(levels_, levels);
  tile_levels_ = std::move(tile_levels);
  drawn_tiles_ = std::move(drawn_tiles);
  begin_x_ = begin_x;
  begin_y_ = begin_y;
  width_ = width;
  height_ = height;
}

void LikelihoodField::prepare(int top_level, int border) {
  SWIFTLET_CHECK(top_level < kLevels, top_level);
  if (!drawn_) return;
  prepared_top_ = std::max(prepared_top_, top_level);
  if (border > border_) reserve(extent_.min_x, extent_.min_y, extent_.max_x, extent_.max_y, border);
  for (int k = 1; k <= top_level; ++k) {
    for (const int tile : drawn_tiles_) {
      std::uint8_t& levels = tile_levels_[static_cast<std::size_t>(tile)];
      if (levels != k) continue;
      updateTile(tile, k);
      levels = static_cast<std::uint8_t>(k + 1);
    }
  }
}

void LikelihoodField::updateTile(int tile, int k) {
  const int tiles_x = width_ / kTile;
  const int x0 = tile % tiles_x * kTile, y0 = tile / tiles_x * kTile;
  const auto fine_stride = static_cast<std::size_t>(width_ >> (k - 1));
  const auto coarse_stride = static_cast<std::size_t>(width_ >> k);
  const std::vector<std::uint8_t>& fine = levels_[static_cast<std::size_t>(k - 1)];
  std::vector<std::uint8_t>& coarse = levels_[static_cast<std::size_t>(k)];
  // A tile is never at the border of the array, so the cells around it exist.
  const int begin_x = (x0 >> k) - 1, end_x = (x0 + kTile) >> k;
  const int begin_y = (y0 >> k) - 1, end_y = (y0 + kTile) >> k;
  for (int y = begin_y; y < end_y; ++y) {
    const std::uint8_t* row =
        &fine[static_cast<std::size_t>(2 * y) * fine_stride + static_cast<std::size_t>(2 * begin_x)];
    std::uint8_t* out = &coarse[static_cast<std::size_t>(y) * coarse_stride + static_cast<std::size_t>(begin_x)];
    coarsen(row, static_cast<std::ptrdiff_t>(fine_stride), end_x - begin_x, out);
  }
}

}  // namespace swiftlet::perception
