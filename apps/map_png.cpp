#include "apps/map_png.hpp"

#include "common/png_encoder.hpp"
#include "rendering/map_renderer.hpp"

namespace swiftlet::apps {

std::string mapPng(const rendering::MapPicture& picture) {
  rendering::MapView view;
  view.width_px = 1280;
  view.height_px = 960;
  const std::vector<std::uint8_t> png = common::encodePng(rendering::renderMap(picture, view));
  return {png.begin(), png.end()};
}

}  // namespace swiftlet::apps
