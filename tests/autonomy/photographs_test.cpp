// Photographs in flight, from frames of which some cannot be used.
#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "common/blank_picture.hpp"
#include "common/whole_frame.hpp"
#include "tests/autonomy/autonomy_story.hpp"

namespace swiftlet::autonomy {
namespace {

/// Of the ten frames that come after it has started, every other is black and the rest are cut short.
TEST(Photographs, OneIsTakenOfTheFirstUsableFrame) {
  common::RgbdCameraConfig camera;
  camera.width_px = 80;
  camera.height_px = 60;
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><Photograph file="door"/><Land/>)", nullptr, &camera);
  int spoiled = 0;
  story.hand = [&](common::SensorEvent& event) {
    auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(&event);
    const bool asked = story.event("mission", "Photograph starts") != story.events.end();
    if (frame == nullptr || !asked || spoiled == 10) return true;
    auto copy = std::make_shared<common::RgbdFrame>(**frame);
    if (++spoiled % 2 == 1)
      std::fill(copy->color.rgb.begin(), copy->color.rgb.end(), std::uint8_t{0});
    else
      copy->color.rgb.resize(copy->color.rgb.size() / 2);
    *frame = copy;
    return true;
  };
  ASSERT_TRUE(story.until([&] { return !story.files.empty(); }, 20.0));
  const auto& photo = std::get<Photo>(story.files.front());
  EXPECT_EQ(spoiled, 10);
  EXPECT_TRUE(isWhole(*photo.frame));
  EXPECT_EQ(common::blankOf(photo.frame->color), common::Blank::kNo);
}

}  // namespace
}  // namespace swiftlet::autonomy
