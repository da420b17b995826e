// The map as a picture, seen from above: what is free, occupied and unknown, the levels, the vehicle with its trail,
// plan and goal, the frontiers with the reason they were left, the last scan, axes and scale.
#pragma once

#include <memory>
#include <optional>

#include "common/sensor_event.hpp"
#include "common/world.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewport.hpp"

namespace swiftlet::rendering {

/// What is drawn above the grid.
struct MapLayers {
  bool metre_lines = true;
  bool levels = true;
  bool frontiers = true;
  bool laser = true;
  bool trail = true;
  bool plan = true;
  bool home = true;
  bool goal = true;
  bool vehicle = true;
  bool legend = true;  ///< Scale bar and axes.
};

struct MapView {
  int width_px = 640;  ///< In [16, 8192].
  int height_px = 480;
  Scheme scheme = Scheme::kLight;
  MapLayers layers;
  /// None: all that is known, by fitViewport(). Its width and height are those above.
  std::optional<Viewport> viewport;
  double hull_diameter_m = 0.55;
};

/// The picture of one snapshot: a pure function, the same bytes for the same arguments.
common::Image renderMap(const common::World& world, const MapView& view);

/// renderMap() for a stream: keeps the grid layer and redraws only where tiles have changed since the last call.
/// The result equals renderMap() byte for byte. One thread at a time.
class MapRenderer {
 public:
  MapRenderer();
  ~MapRenderer();
  MapRenderer(MapRenderer&&) noexcept;
  MapRenderer& operator=(MapRenderer&&) noexcept;

  common::Image render(const common::World& world, const MapView& view);

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace swiftlet::rendering
