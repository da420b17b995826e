// Points of surfaces, each drawn as a disc, the nearest in front.
#pragma once

#include <vector>

#include "rendering/depth_buffer.hpp"
#include "rendering/picture3d.hpp"
#include "rendering/viewpoint3d.hpp"

namespace swiftlet::rendering {

/// Draws the points in front of the eye. A surface that is seen from its back is left out, so that one looks into a
/// room from outside; a point without a normal is drawn from everywhere.
void drawSurface(const PlacedSurface& surface, const Eye& eye, PointColor coloring, DepthBuffer& buffer);

/// drawSurface() for all surfaces of a stream's pictures. It keeps what it has drawn while the eye stays where it is,
/// and then draws only surfaces that are new or have changed. The result is the same as without. One thread at a time.
class SurfaceLayer {
 public:
  /// The reference is valid until the next call.
  const DepthBuffer& draw(const std::vector<PlacedSurface>& surfaces, const Eye& eye, PointColor coloring);

 private:
  bool fits(const std::vector<PlacedSurface>& surfaces, const Eye& eye, PointColor coloring) const;

  /// All but the last surface, which is the one that grows.
  DepthBuffer settled_;
  std::vector<PlacedSurface> drawn_;  ///< What `settled_` shows; kept alive, so that an address stays unique.
  Eye eye_;
  PointColor coloring_ = PointColor::kMeasured;
  DepthBuffer all_;
};

}  // namespace swiftlet::rendering
