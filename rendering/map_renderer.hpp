// A map in pixels, seen from above: free, occupied and unknown cells, with a line every metre, the levels, the
// frontiers with the reason they were left, a scan, lines and marks, axes and scale.
#pragma once

#include <memory>
#include <optional>

#include "common/image.hpp"
#include "rendering/map_picture.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewport.hpp"

namespace swiftlet::rendering {

struct MapView {
  int width_px = 640;  ///< In [16, 8192].
  int height_px = 480;
  Scheme scheme = Scheme::kLight;
  /// nullopt: the known map and the points of in_view_map_m, by fitViewport(). Its width and height are those above.
  std::optional<Viewport> viewport;
};

/// A pure function: the same bytes for the same arguments.
common::Image renderMap(const MapPicture& picture, const MapView& view);

/// renderMap() for a stream: it keeps the grid layer and redraws only tiles that have changed since the last call. The
/// result equals renderMap() byte for byte. One thread at a time.
class MapRenderer {
 public:
  MapRenderer();
  ~MapRenderer();
  MapRenderer(MapRenderer&&) noexcept;
  MapRenderer& operator=(MapRenderer&&) noexcept;

  common::Image render(const MapPicture& picture, const MapView& view);

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace swiftlet::rendering
