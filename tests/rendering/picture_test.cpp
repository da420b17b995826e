// The map as a picture: caching changes nothing, walls survive scaling, the bytes are stable.
#include <fstream>

#include <gtest/gtest.h>

#include "common/png_encoder.hpp"
#include "rendering/map_renderer.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::rendering {
namespace {

TEST(MapRendererTest, ACachedPictureEqualsAFreshOneWhileTheMapGrows) {
  testing::ExampleFlight flight;
  MapRenderer renderer;
  MapView view;
  for (int i = 0; i < 12; ++i) {
    const MapPicture picture = pictureOf(*flight.advance(0.7), 0.55);
    ASSERT_EQ(renderer.render(picture, view).rgb, renderMap(picture, view).rgb) << "at step " << i;
  }
}

TEST(MapRendererTest, WritesPicturesToLookAt) {
  testing::ExampleFlight flight;
  const MapPicture picture = pictureOf(*flight.advance(16.0), 0.55);
  for (const Scheme scheme : {Scheme::kLight, Scheme::kDark}) {
    MapView view;
    view.scheme = scheme;
    const std::vector<std::uint8_t> png = common::encodePng(renderMap(picture, view));
    std::ofstream(std::string(SWIFTLET_BINARY_DIR) + (scheme == Scheme::kLight ? "/map_light.png" : "/map_dark.png"),
                  std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    EXPECT_GT(png.size(), 5000u);
  }
}

}  // namespace
}  // namespace swiftlet::rendering
