// The likelihood field: for each cell, how likely a beam ends there given the contours drawn so far, as a byte. A value
// is 255 (1 - d^2 / (3 sigma)^2) for the distance d to the nearest contour and 0 beyond 3 sigma. This is the logarithm
// of a Gaussian on top of a constant share of outliers. Drawing touches only cells near contours (Bachrach 2009,
// section 5.1.1).
//
// Coarser levels hold upper bounds: cell X of level k covers the cells X 2^k .. X 2^k + 2^(k+1) - 2 of the finest
// level. One look-up therefore bounds the value of a point anywhere in the cell when it is moved by 0 .. 2^k - 1 cells
// (Olson 2009).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {

/// A rectangle of cells; the greatest ones belong to it.
struct CellExtent {
  int min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

/// Not thread-safe. A pointer from `level` is valid until the next non-const call.
class LikelihoodField {
 public:
  static constexpr int kTopValue = 255;
  static constexpr int kLevels = 7;
  static constexpr int kTile = 64;
  /// Half width of the widest kernel, in cells.
  static constexpr int kMaxKernelCells = 7;

  /// 3 sigma must be at most kMaxKernelCells cells.
  LikelihoodField(double resolution_m, double sigma_m);

  double resolution_m() const { return resolution_m_; }
  /// The distance from a contour beyond which a point has no support.
  double reach_m() const { return 3.0 * sigma_m_; }

  void clear();
  void draw(std::span<const ContourSegment> segments_reference_m);
  bool empty() const { return !drawn_; }

  /// Brings levels 0 .. top_level up to date and makes a window of `border` cells beside anything drawn addressable.
  void prepare(int top_level, int border);

  struct Level {
    const std::uint8_t* cells = nullptr;
    int stride = 0;
  };
  Level level(int k) const { return {levels_[static_cast<std::size_t>(k)].data(), width_ >> k}; }
  /// The first cell of the array at the finest level, relative to the origin of the reference frame.
  int beginX() const { return begin_x_; }
  int beginY() const { return begin_y_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// The value at a cell of the finest level; 0 outside the array.
  std::uint8_t at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
    return levels_[0][static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

 private:
  static constexpr int kKernelSize = 16;
  static constexpr int kSubcells = 4;

  void makeKernels();
  void reserve(int min_x, int min_y, int max_x, int max_y, int border);
  void stamp(double x_cells, double y_cells);
  void markTile(int tile);
  void updateTile(int tile, int level);

  double resolution_m_;
  double sigma_m_;
  std::array<std::array<std::uint8_t, std::size_t{kKernelSize} * kKernelSize>, std::size_t{kSubcells} * kSubcells>
      kernels_{};

  int begin_x_ = 0, begin_y_ = 0;  // Multiples of kTile.
  int width_ = 0, height_ = 0;
  int border_ = kTile;
  CellExtent extent_;  ///< Of the drawn cells, relative to the origin of the reference frame.
  bool drawn_ = false;
  int prepared_top_ = 0;  ///< Highest level ever computed.
  std::array<std::vector<std::uint8_t>, kLevels> levels_;
  std::array<std::vector<std::uint8_t>, kLevels> spare_levels_;  ///< Buffers for the next time the array grows.

  /// For each tile of the finest level: levels below this are up to date; 0: never drawn.
  std::vector<std::uint8_t> tile_levels_;
  std::vector<int> drawn_tiles_;
};

}  // namespace swiftlet::perception
