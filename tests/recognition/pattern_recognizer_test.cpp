#include "perception/recognition/pattern_recognizer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/random.hpp"
#include "perception/recognition/histogram_recognizer.hpp"
#include "perception/recognition/picture_pyramid.hpp"
#include "perception/recognition/tag_recognizer.hpp"
#include "tests/recognition/pattern_scene.hpp"

namespace swiftlet::perception {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr double kWidth_m = 0.5;
constexpr int kPrint_px = 200;

PatternTemplate mark() { return *PatternTemplate::create("mark", landingMark(kPrint_px), kWidth_m); }

const Prints& prints() {
  static const Prints kPrints{landingMark(kPrint_px), landingDecoys(kPrint_px)};
  return kPrints;
}

/// A picture of the mark alone, near and straight.
PatternScene plainScene() {
  PatternScene scene = drawScene(6, 0, kWidth_m);
  scene.decoys.clear();
  scene.occluded_share = scene.shading = scene.motion_px = 0.0;
  scene.brightness = 1.0;
  scene.noise = 1.0;
  Eigen::Matrix3d facing;
  facing << 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0;
  scene.pattern.T_camera_sheet = T_camera_plane({facing, {0.02, 0.05, 1.6}});
  scene.pattern.size_px = 144.0;
  return scene;
}

double offCorners_px(const common::Pose3& estimate, const common::Pose3& truth) {
  const PatternAligner aligner(mark());
  return aligner.cornerDistance_px(sceneCamera(), planarPose(estimate), planarPose(truth));
}

TEST(PatternAligner, ComesBackFromAPoseThatIsOffByAFewPixels) {
  const PatternScene scene = plainScene();
  const CameraPicture picture = render(scene, prints(), {});
  const std::vector<vision::GrayImage> levels = pyramidOf(picture.gray, 30);
  const PatternAligner aligner(mark());
  const PlanarPose truth = planarPose(scene.pattern.T_camera_sheet);
  common::RandomStream random(1, "aligner_test");
  for (int i = 0; i < 10; ++i) {
    Eigen::Matrix<double, 6, 1> step;
    for (int k = 0; k < 6; ++k) step[k] = random.gaussian(k < 3 ? 0.03 : 0.01);
    const auto coarse = aligner.align(levels, picture.camera, moved(truth, step), 56.0);
    ASSERT_TRUE(coarse) << i;
    const auto fine = aligner.alignFinely(levels, picture.camera, coarse->pose, 160.0,
                                          aligner.blur_px(levels, picture.camera, coarse->pose, 160.0));
    ASSERT_TRUE(fine) << i;
    EXPECT_LT(aligner.cornerDistance_px(picture.camera, fine->pose, truth), 0.1) << i;
  }
}

TEST(PatternRecognizer, FindsTheMarkInClutterAmongDecoysAndNothingElse) {
  PatternRecognizer recognizer(mark());
  for (std::uint64_t i = 0; i < 20; ++i) {
    const PatternScene scene = drawScene(7, i, kWidth_m);
    if (scene.has_pattern && scene.pattern.size_px < 40.0) continue;
    const CameraPicture picture = render(scene, prints(), {});
    const auto found = recognizer.recognize({&picture, nullptr});
    ASSERT_THAT(found, SizeIs(scene.has_pattern ? 1 : 0)) << i;
    if (!scene.has_pattern) continue;
    EXPECT_EQ(found[0].what, "mark");
    EXPECT_LT(offCorners_px(found[0].T_sensor_object, scene.pattern.T_camera_sheet), 0.02 * scene.pattern.size_px) << i;
    EXPECT_GT(found[0].confidence, 0.5);
    EXPECT_LE(found[0].confidence, 1.0);
  }
}

TEST(PatternRecognizer, RefusesTheMirrorImage) {
  PatternRecognizer recognizer(mark());
  const CameraPicture picture = render(plainScene(), {mirrored(landingMark(kPrint_px)), landingDecoys(kPrint_px)}, {});
  EXPECT_THAT(recognizer.recognize({&picture, nullptr}), IsEmpty());
}

TEST(PatternRecognizer, TheSamePictureGivesTheSameBits) {
  PatternRecognizer recognizer(mark()), other(mark());
  const CameraPicture picture = render(plainScene(), prints(), {});
  const CameraPicture between = render(drawScene(8, 2, kWidth_m), prints(), {});
  const auto first = recognizer.recognize({&picture, nullptr});
  recognizer.recognize({&between, nullptr});
  const auto again = recognizer.recognize({&picture, nullptr}), elsewhere = other.recognize({&picture, nullptr});
  ASSERT_THAT(first, SizeIs(1));
  for (const auto& result : {again, elsewhere}) {
    ASSERT_THAT(result, SizeIs(1));
    EXPECT_EQ(result[0].T_sensor_object.position_m, first[0].T_sensor_object.position_m);
    EXPECT_EQ(result[0].T_sensor_object.rotation.coeffs(), first[0].T_sensor_object.rotation.coeffs());
    EXPECT_EQ(result[0].covariance, first[0].covariance);
  }
}

TEST(PatternRecognizer, TwoPrintsAreTwoObjects) {
  PatternRecognizer recognizer(mark());
  PatternScene scene = plainScene();
  PlacedSheet second = scene.pattern;
  second.T_camera_sheet.position_m += Eigen::Vector3d(0.0, 0.8, 0.1);
  scene.decoys = {second};
  const CameraPicture picture = render(scene, {landingMark(kPrint_px), {landingMark(kPrint_px)}}, {});
  EXPECT_THAT(recognizer.recognize({&picture, nullptr}), SizeIs(2));
}

TEST(PatternRecognizer, APictureThatIsTornOrMissingShowsNothing) {
  PatternRecognizer recognizer(mark());
  CameraPicture picture = render(plainScene(), prints(), {});
  picture.gray.values.pop_back();
  EXPECT_THAT(recognizer.recognize({&picture, nullptr}), IsEmpty());
  EXPECT_THAT(recognizer.recognize({}), IsEmpty());
  CameraPicture tiny{{1, 1, 1.0, 1.0, 0.0, 0.0}, {1, 1, {7}}};
  EXPECT_THAT(recognizer.recognize({&tiny, nullptr}), IsEmpty());
}

/// What it was published for: a landing zone seen from above.
TEST(HistogramRecognizer, FindsASharpPictureFromTheFront) {
  const auto shapes = PatternTemplate::create("shapes", shapesDrawing(kPrint_px), kWidth_m);
  ASSERT_TRUE(shapes);
  HistogramRecognizer recognizer(*shapes);
  const PatternScene scene = plainScene();
  const CameraPicture picture = render(scene, {shapesDrawing(kPrint_px), {shapesDrawing(kPrint_px)}}, {});
  const auto found = recognizer.recognize({&picture, nullptr});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_LT(offCorners_px(found[0].T_sensor_object, scene.pattern.T_camera_sheet), 0.1 * scene.pattern.size_px);
}

TEST(OrientationHistogram, OfATurnedPatchIsTheSameTurned) {
  const vision::GrayImage mark_picture = landingMark(64);
  vision::GrayImage turned = mark_picture;
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u)
      turned.values[static_cast<std::size_t>(v * 64 + u)] = static_cast<std::uint8_t>(mark_picture.at(v, 63 - u));
  const auto one = orientationHistogram(mark_picture, 20, 24), other = orientationHistogram(turned, 63 - 24, 20);
  ASSERT_TRUE(one);
  ASSERT_TRUE(other);
  EXPECT_GT(correlation(*one, *other), 0.95F);
  EXPECT_EQ((other->turn_bins - one->turn_bins + 36) % 36, 9);
}

TEST(TagRecognizer, FindsItsTagAndNoOther) {
  auto recognizer = TagRecognizer::create({{"base", 17, 0.8 * kWidth_m}});
  ASSERT_TRUE(recognizer);
  const PatternScene scene = plainScene();
  const CameraPicture picture = render(scene, {drawTag(17, 20), {drawTag(17, 20)}}, {});
  const auto found = recognizer->recognize({&picture, nullptr});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].what, "base");
  EXPECT_LT(offCorners_px(found[0].T_sensor_object, scene.pattern.T_camera_sheet), 0.5);
  const CameraPicture another = render(scene, {drawTag(18, 20), {drawTag(18, 20)}}, {});
  EXPECT_THAT(recognizer->recognize({&another, nullptr}), IsEmpty());
}

TEST(TagRecognizer, WithoutASizeOrWithAnUnknownIdIsRefused) {
  EXPECT_EQ(TagRecognizer::create({{"base", 587, 0.4}}).error().name(), "tag.no-id");
  EXPECT_EQ(TagRecognizer::create({{"base", -1, 0.4}}).error().name(), "tag.no-id");
  EXPECT_EQ(TagRecognizer::create({{"base", 3, 0.0}}).error().name(), "tag.no-size");
}

}  // namespace
}  // namespace swiftlet::perception
