// The pictures that the query of an address asks for. A parameter that is not known or not valid is refused (400).
// Widths, heights and rates that are too large are reduced to what is offered; a viewpoint outside its bounds is
// refused.
#pragma once

#include "web/server/picture_view.hpp"
#include "web/server/target.hpp"

namespace swiftlet::web {

struct PictureQuery {
  PictureView view;
  double fps = 10.0;
};

PictureQuery mapStream(const Target& target);
PictureQuery map3dStream(const Target& target);
PictureQuery cameraStream(const Target& target);
PictureQuery depthStream(const Target& target);
/// A single picture, which has no rate.
PictureView mapPicture(const Target& target);

}  // namespace swiftlet::web
