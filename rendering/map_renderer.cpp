#include "rendering/map_renderer.hpp"

#include <algorithm>

#include "common/check.hpp"
#include "rendering/grid_layer.hpp"
#include "rendering/map_layers.hpp"

namespace swiftlet::rendering {
namespace {

Viewport viewportOf(const MapPicture& picture, const MapView& view) {
  SWIFTLET_CHECK(view.width_px >= 16 && view.width_px <= 8192 && view.height_px >= 16 && view.height_px <= 8192,
                 view.width_px, view.height_px);
  Viewport viewport =
      view.viewport ? *view.viewport : fitViewport(*picture.grid, picture.in_view_map_m, view.width_px, view.height_px);
  viewport.width_px = view.width_px;
  viewport.height_px = view.height_px;
  return viewport;
}

common::Image gridLayer(const common::OccupancyGrid& grid, const Viewport& viewport, Scheme scheme) {
  common::Image image{viewport.width_px, viewport.height_px, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  drawGrid(grid, viewport, themeOf(scheme), {0, 0, image.width_px, image.height_px}, image);
  return image;
}

common::Image withLayers(common::Image grid_layer, const MapPicture& picture, const MapView& view,
                         const Viewport& viewport) {
  Canvas canvas(std::move(grid_layer));
  Layer layer{canvas, viewport, view.scheme, std::max(0.6, std::min(view.width_px, view.height_px * 4 / 3) / 640.0)};
  drawMetreLines(layer, picture.shown);
  if (picture.levels) drawLevels(layer, *picture.levels);
  if (picture.frontiers) drawFrontiers(layer, *picture.frontiers, picture.grid->resolution_m());
  drawScan(layer, picture.scan_map_m);
  for (const MapLine& line : picture.lines) drawLine(layer, line);
  for (const MapMark& mark : picture.marks) drawMark(layer, mark);
  drawLegend(layer, picture.shown);
  return canvas.take();
}

}  // namespace

common::Image renderMap(const MapPicture& picture, const MapView& view) {
  const Viewport viewport = viewportOf(picture, view);
  return withLayers(gridLayer(*picture.grid, viewport, view.scheme), picture, view, viewport);
}

/// The grid of the last call is kept alive, so that a tile at the same address is the same tile.
struct MapRenderer::Cache {
  std::shared_ptr<const common::OccupancyGrid> grid;
  Viewport viewport;
  Scheme scheme = Scheme::kLight;
  common::Image layer;

  bool fits(const common::OccupancyGrid& next, const Viewport& v, Scheme s) const {
    return grid && grid->resolution_m() == next.resolution_m() && viewport == v && scheme == s;
  }

  void update(const common::OccupancyGrid& next) {
    const common::CellRect before = grid->extent(), after = next.extent();
    const common::CellRect all{{std::min(before.begin.x, after.begin.x), std::min(before.begin.y, after.begin.y)},
                               {std::max(before.end.x, after.end.x), std::max(before.end.y, after.end.y)}};
    constexpr int kTile = common::OccupancyGrid::kTileSize;
    for (int y = all.begin.y; y < all.end.y; y += kTile)
      for (int x = all.begin.x; x < all.end.x; x += kTile)
        if (grid->tileIdentity({x, y}) != next.tileIdentity({x, y}))
          drawGrid(next, viewport, themeOf(scheme),
                   pixelsOf({{x, y}, {x + kTile, y + kTile}}, next.resolution_m(), viewport), layer);
  }
};

MapRenderer::MapRenderer() : cache_(std::make_unique<Cache>()) {}
MapRenderer::~MapRenderer() = default;
MapRenderer::MapRenderer(MapRenderer&&) noexcept = default;
MapRenderer& MapRenderer::operator=(MapRenderer&&) noexcept = default;

common::Image MapRenderer::render(const MapPicture& picture, const MapView& view) {
  const Viewport viewport = viewportOf(picture, view);
  if (cache_->fits(*picture.grid, viewport, view.scheme)) {
    cache_->update(*picture.grid);
  } else {
    cache_->layer = gridLayer(*picture.grid, viewport, view.scheme);
    cache_->viewport = viewport;
    cache_->scheme = view.scheme;
  }
  cache_->grid = picture.grid;
  return withLayers(cache_->layer, picture, view, viewport);
}

}  // namespace swiftlet::rendering
