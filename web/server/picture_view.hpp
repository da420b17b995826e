// A picture that clients ask for.
#pragma once

#include <compare>

#include "rendering/picture3d.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewpoint3d.hpp"

namespace swiftlet::web {

/// A picture requested by a client; equal views share one encoding.
struct PictureView {
  enum class Source { kMap, kCamera, kMap3d, kDepth };
  Source source = Source::kMap;
  int width_px = 640;
  int height_px = 480;  ///< Height of a map; camera and depth keep their aspect ratio.
  rendering::Scheme scheme = rendering::Scheme::kLight;
  rendering::PointColor coloring = rendering::PointColor::kMeasured;  ///< Of the 3D map.
  rendering::Viewpoint3d viewpoint;                                   ///< Of the 3D map.

  auto operator<=>(const PictureView&) const = default;
};

}  // namespace swiftlet::web
