// The occupancy grid as the lowest layer of a picture, each pixel the mean of the cells it covers: walls stay visible
// when many cells share a pixel, and cell borders are smooth when a cell covers many.
#pragma once

#include <array>

#include "common/image.hpp"
#include "common/occupancy_grid.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewport.hpp"

namespace swiftlet::rendering {

/// A half-open rectangle in pixels.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// The colours of cell values; the index is value + 128.
std::array<Color, 256> cellColors(const Theme& theme);

/// Paints `rect` of `image`, which has the size of the viewport. The pixels do not depend on the choice of `rect`.
void drawGrid(const common::OccupancyGrid& grid, const Viewport& viewport, const Theme& theme, const PixelRect& rect,
              common::Image& image);

/// The pixels a rectangle of cells can influence, clipped to the picture.
PixelRect pixelsOf(const common::CellRect& cells, double resolution_m, const Viewport& viewport);

}  // namespace swiftlet::rendering
