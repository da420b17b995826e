// A 3D map in pixels, without a GPU: surfaces as discs, the nearest in front, shaded at edges in depth; over them a
// grid on the floor with a line every metre, the trail, the plan, the vehicle and its camera. What a surface hides of
// these is drawn faintly.
#pragma once

#include <memory>

#include "common/image.hpp"
#include "rendering/picture3d.hpp"
#include "rendering/surface_layer.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewpoint3d.hpp"

namespace swiftlet::rendering {

struct Map3dView {
  int width_px = 640;  ///< In [16, 8192].
  int height_px = 480;
  Scheme scheme = Scheme::kDark;
  PointColor coloring = PointColor::kMeasured;
  Viewpoint3d viewpoint;
};

/// A pure function: the same bytes for the same arguments.
common::Image renderMap3d(const Picture3d& picture, const Map3dView& view);

/// renderMap3d() for a stream, which draws again only what has changed (see SurfaceLayer). The result equals
/// renderMap3d() byte for byte. One thread at a time.
class Map3dRenderer {
 public:
  common::Image render(const Picture3d& picture, const Map3dView& view);

 private:
  SurfaceLayer surfaces_;
};

}  // namespace swiftlet::rendering
