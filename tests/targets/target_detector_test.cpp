// What counts as a target in one frame, in pictures of the simulated camera.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "perception/targets/target_detector.hpp"
#include "tests/targets/target_scene.hpp"

namespace swiftlet::perception::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

const Eigen::Vector3d kAhead(2.5, 0.2, -0.3);

std::vector<TargetSighting> sightingsIn(const simulation::WorldModel& world,
                                        const std::vector<TargetClassConfig>& classes = redAndGreen()) {
  return TargetDetector(classes).detect(simulation::frameOf(world, flyingCamera(), simulation::RgbdErrorsConfig{}));
}

TEST(ColorClasses, HueAndSaturationDoNotDependOnTheBrightness) {
  const ColorClasses classes(redAndGreen());
  for (const double brightness : {1.0, 0.6, 0.25}) {
    const auto channel = [&](double value) { return static_cast<std::uint8_t>(255.0 * brightness * value); };
    EXPECT_EQ(classes.of(channel(0.95), channel(0.1), channel(0.1)), 0) << brightness;
    EXPECT_EQ(classes.of(channel(0.1), channel(0.9), channel(0.2)), 1) << brightness;
    EXPECT_EQ(classes.of(channel(0.9), channel(0.5), channel(0.1)), ColorClasses::kNone) << "orange " << brightness;
    EXPECT_EQ(classes.of(channel(0.8), channel(0.7), channel(0.7)), ColorClasses::kNone) << "pale " << brightness;
  }
  EXPECT_EQ(classes.of(9, 0, 0), ColorClasses::kNone) << "too dark to tell";
}

TEST(ColorClasses, AColourOfSeveralClassesBelongsToTheNearestHue) {
  const std::vector<TargetClassConfig> near = {{.name = "red", .hue_deg = 0.0, .hue_tolerance_deg = 40.0},
                                               {.name = "orange", .hue_deg = 30.0, .hue_tolerance_deg = 40.0}};
  const ColorClasses classes(near);
  EXPECT_EQ(classes.of(220, 30, 20), 0);
  EXPECT_EQ(classes.of(220, 110, 20), 1);
  EXPECT_EQ(hueDifference_deg(350.0, 10.0), 20.0);
}

TEST(TargetDetector, PlacesATargetAtItsMiddle) {
  const auto sightings = sightingsIn(roomWith({cube(kAhead, 0.24, kRed)}));
  ASSERT_THAT(sightings, SizeIs(1));
  EXPECT_EQ(sightings[0].color, 0);
  EXPECT_LT((sightings[0].point_camera_m - kAhead).norm(), 0.06);
  EXPECT_NEAR(sightings[0].diameter_m, 0.27, 0.05);
}

TEST(TargetDetector, FindsItInDimAndInColouredLight) {
  for (const Color& light : {Color(0.4F, 0.4F, 0.4F), Color(1.12F, 1.0F, 0.88F), Color(0.88F, 1.0F, 1.12F)}) {
    simulation::WorldModel world = roomWith({cube(kAhead, 0.24, kRed), cube({2.2, -0.7, 0.1}, 0.2, kGreen)});
    world.light = light;
    EXPECT_THAT(sightingsIn(world), SizeIs(2)) << light.transpose();
  }
}

TEST(TargetDetector, APictureOnAWallIsNoTarget) {
  simulation::Shape picture = simulation::boxShape("picture", {3.998, -0.15, -0.2}, {4.0, 0.15, 0.1});
  picture.color = kRed;
  picture.pattern = simulation::Pattern::kBlank;
  EXPECT_THAT(sightingsIn(roomWith({picture})), IsEmpty());
  // The same picture in front of the wall is a plate that stands out.
  for (Eigen::Vector3f& vertex : picture.vertices_world_m) vertex.x() -= 0.5F;
  EXPECT_THAT(sightingsIn(roomWith({picture})), SizeIs(1));
}

TEST(TargetDetector, ANearHueIsNone) { EXPECT_THAT(sightingsIn(roomWith({cube(kAhead, 0.24, kOrange)})), IsEmpty()); }

TEST(TargetDetector, OneOfAnotherSizeIsNone) {
  std::vector<TargetClassConfig> small = redAndGreen();
  small[0].diameter_m = 0.12;
  EXPECT_THAT(sightingsIn(roomWith({cube(kAhead, 0.24, kRed)}), small), IsEmpty());
  EXPECT_THAT(sightingsIn(roomWith({cube(kAhead, 0.11, kRed)}), small), SizeIs(1));
  EXPECT_THAT(sightingsIn(roomWith({cube({3.5, 0.0, 0.0}, 0.9, kRed)})), IsEmpty()) << "a cupboard";
}

TEST(TargetDetector, SeveralOfOneColourStaySeparate) {
  EXPECT_THAT(sightingsIn(roomWith({cube({2.0, 0.2, 0.0}, 0.2, kRed), cube({2.0, -0.2, 0.0}, 0.2, kRed)})), SizeIs(2))
      << "side by side";
  EXPECT_THAT(sightingsIn(roomWith({cube({1.8, 0.0, -0.1}, 0.2, kRed), cube({3.2, 0.18, -0.1}, 0.2, kRed)})), SizeIs(2))
      << "one half behind the other in the picture";
}

TEST(TargetDetector, OneAtTheEdgeOfThePictureIsNotMeasured) {
  EXPECT_THAT(sightingsIn(roomWith({cube({2.0, 1.1, 0.0}, 0.3, kRed)})), IsEmpty());
}

TEST(TargetDetector, BadFramesHaveNone) {
  common::RgbdFrame frame =
      simulation::frameOf(roomWith({cube(kAhead, 0.24, kRed)}), flyingCamera(), simulation::RgbdErrorsConfig{});
  const TargetDetector detector(redAndGreen());
  common::RgbdFrame cut = frame;
  cut.depth.depth_m.resize(100);
  EXPECT_THAT(detector.detect(cut), IsEmpty());
  for (float& depth_m : frame.depth.depth_m) depth_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(detector.detect(frame), IsEmpty());
  EXPECT_THAT(detector.detect({}), IsEmpty());
}

}  // namespace
}  // namespace swiftlet::perception::testing
