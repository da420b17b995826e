// Pictures of 3D maps: what is in front, where a point appears, and in which colour.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "rendering/depth_picture.hpp"
#include "rendering/map3d_renderer.hpp"
#include "tests/rendering/example_flight.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::rendering {
namespace {

using common::SurfacePoint;
using Eigen::Vector3d;
using Eigen::Vector3f;

using Rgb = std::array<std::uint8_t, 3>;

Rgb pixel(const common::Image& image, int u, int v) {
  const std::uint8_t* at = &image.rgb[3 * static_cast<std::size_t>(v * image.width_px + u)];
  return {at[0], at[1], at[2]};
}

PlacedSurface surfaceOf(std::vector<SurfacePoint> points, const common::Pose3& T_map_points = {}) {
  return {std::make_shared<const std::vector<SurfacePoint>>(std::move(points)), T_map_points};
}

/// A square of 1 m that faces -x.
PlacedSurface wallAt(double x_m, const Rgb& rgb, float apart_m = 0.02F) {
  std::vector<SurfacePoint> points;
  for (float y = -0.5F; y < 0.505F; y += apart_m)
    for (float z = -0.5F; z < 0.505F; z += apart_m) points.push_back({Vector3f(0.0F, y, z), -Vector3f::UnitX(), rgb});
  return surfaceOf(std::move(points), {Eigen::Quaterniond::Identity(), {x_m, 0.0, 0.0}});
}

/// Looks along x of the map, from the origin.
Eye eyeAtOrigin() { return {{}, {320, 240, 300.0, 300.0, 159.5, 119.5}}; }

DepthBuffer drawn(const std::vector<PlacedSurface>& surfaces, const Eye& eye,
                  PointColor coloring = PointColor::kMeasured) {
  return SurfaceLayer().draw(surfaces, eye, coloring);
}

constexpr Rgb kRed{200, 30, 20}, kBlue{10, 40, 210};

TEST(SurfaceLayerTest, APointAppearsWhereTheLensProjectsIt) {
  const Eye eye = eyeAtOrigin();
  const Vector3d point_map_m(3.0, 0.5, -0.3);
  const DepthBuffer buffer = drawn({surfaceOf({{point_map_m.cast<float>(), Vector3f::Zero(), kRed}})}, eye);
  const Eigen::Vector2d at = eye.lens.pixel(point_map_m);
  double sum_u = 0.0, sum_v = 0.0;
  int count = 0;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      if (!buffer.isEmpty(u, v)) {
        sum_u += u;
        sum_v += v;
        ++count;
        EXPECT_FLOAT_EQ(buffer.depth_m(u, v), 3.0F);
        EXPECT_EQ(buffer.rgb(u, v), 0xc81e14U);
      }
  // The disc of 3.5 cm is 3.5 pixels wide at 3 m.
  ASSERT_GE(count, 5);
  ASSERT_LE(count, 21);
  EXPECT_NEAR(sum_u / count, at.x(), 0.51);
  EXPECT_NEAR(sum_v / count, at.y(), 0.51);
}

TEST(SurfaceLayerTest, TheNearestSurfaceIsInFrontInWhateverOrderTheyAreDrawn) {
  const Eye eye = eyeAtOrigin();
  const PlacedSurface near = wallAt(2.0, kRed), far = wallAt(3.0, kBlue);
  for (const auto& surfaces : {std::vector{near, far}, std::vector{far, near}}) {
    const DepthBuffer buffer = drawn(surfaces, eye);
    EXPECT_EQ(buffer.rgb(160, 120), 0xc81e14U);
    EXPECT_FLOAT_EQ(buffer.depth_m(160, 120), 2.0F);
  }
  EXPECT_FLOAT_EQ(drawn({far}, eye).depth_m(160, 120), 3.0F);
}

/// Nowhere on a wall of wallAt() at that distance is the background seen.
void expectClosed(const PlacedSurface& surface, double distance_m) {
  const DepthBuffer buffer = drawn({surface}, eyeAtOrigin());
  const double half_px = 0.46 * 300.0 / distance_m;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      ASSERT_FALSE(std::abs(u - 159.5) < half_px && std::abs(v - 119.5) < half_px && buffer.isEmpty(u, v))
          << u << " " << v << " at " << distance_m;
}

TEST(SurfaceLayerTest, AClosedSurfaceHasNoHoles) {
  for (const double distance_m : {0.6, 1.0, 2.5, 6.0}) expectClosed(wallAt(distance_m, kRed), distance_m);
}

TEST(SurfaceLayerTest, DiscsBridgeTheDistanceOfNoisyPointsAndOfThinnedOnes) {
  for (const double distance_m : {0.6, 2.5, 6.0}) {
    PlacedSurface noisy = wallAt(distance_m, kRed, 0.08F), thinned = wallAt(distance_m, kRed, 0.04F);
    noisy.coarse = noisy.points->size();
    expectClosed(noisy, distance_m);
    thinned.cube_m = 0.04;
    expectClosed(thinned, distance_m);
  }
}

TEST(SurfaceLayerTest, ASurfaceIsNotSeenFromItsBack) {
  Eye behind = eyeAtOrigin();
  behind.T_map_eye = {common::quaternionFrom({0.0, 0.0, M_PI}), {4.0, 0.0, 0.0}};
  EXPECT_TRUE(drawn({wallAt(2.0, kRed)}, behind).isEmpty(160, 120));
  const PlacedSurface without_normal = surfaceOf({{Vector3f(2.0F, 0.0F, 0.0F), Vector3f::Zero(), kRed}});
  EXPECT_FALSE(drawn({without_normal}, behind).isEmpty(160, 120));
}

TEST(SurfaceLayerTest, NothingBehindTheEyeOrNotFiniteIsDrawn) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), big = std::numeric_limits<float>::infinity();
  std::vector<SurfacePoint> points{{Vector3f(-2.0F, 0.0F, 0.0F), Vector3f::Zero(), kRed},
                                   {Vector3f(0.01F, 0.0F, 0.0F), Vector3f::Zero(), kRed},
                                   {Vector3f(nan, 0.0F, 0.0F), Vector3f::Zero(), kRed},
                                   {Vector3f(2.0F, nan, 0.0F), Vector3f::Zero(), kRed},
                                   {Vector3f(2.0F, big, 0.0F), Vector3f::Zero(), kRed}};
  const DepthBuffer buffer = drawn({surfaceOf(points)}, eyeAtOrigin());
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) ASSERT_TRUE(buffer.isEmpty(u, v));
}

TEST(SurfaceLayerTest, ColoursOfNormalsAreThoseOfTheMapWhateverTheFrameOfThePoints) {
  const Vector3f normal_map = -Vector3f::UnitX();
  const common::Pose3 T_map_points{common::quaternionFrom({0.3, -0.4, 1.2}), {0.5, -1.0, 0.2}};
  const Vector3d at_points_m = T_map_points.inverse() * Vector3d(2.0, 0.0, 0.0);
  const Vector3f normal_points = (T_map_points.rotation.inverse() * normal_map.cast<double>()).cast<float>();
  const DepthBuffer buffer = drawn({surfaceOf({{at_points_m.cast<float>(), normal_points, kRed}}, T_map_points)},
                                   eyeAtOrigin(), PointColor::kNormal);
  const std::uint32_t rgb = buffer.rgb(160, 120);
  EXPECT_NEAR(rgb >> 16, 0, 1);
  EXPECT_NEAR(rgb >> 8 & 255, 128, 1);
  EXPECT_NEAR(rgb & 255, 128, 1);
}

/// The flat from a flight, with all of it known.
Picture3d pictureOfFlight(double seconds) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  return picture3dOf(*flight.advance(seconds), 0.55);
}

TEST(Map3dRendererTest, AStreamShowsTheSameAsASinglePictureWhileTheMapGrowsAndBends) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  Map3dRenderer stream;
  Map3dView view;
  view.width_px = 160;
  view.height_px = 120;
  view.viewpoint = {Viewpoint3d::Kind::kOrbit, 3.0, 1.0, 0.0, 9.0, -1.2, 0.9};
  for (int i = 0; i < 24; ++i) {
    const auto world = i % 9 == 7 ? (flight.closeLoop(0.1), flight.advance(0.0)) : flight.advance(0.7);
    if (i == 15) view.viewpoint.azimuth_rad = 1.0;
    if (i == 18) view.coloring = PointColor::kNormal;
    if (i > 20) view.viewpoint.kind = Viewpoint3d::Kind::kFollow;
    const Picture3d picture = picture3dOf(*world, 0.55);
    ASSERT_EQ(stream.render(picture, view).rgb, renderMap3d(picture, view).rgb) << i;
  }
}

TEST(Map3dRendererTest, ALoopClosureMovesWhatHangsOnItsKeyScans) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  const Picture3d before = picture3dOf(*flight.advance(12.0), 0.55);
  ASSERT_GE(before.surfaces.size(), 3U);
  flight.closeLoop(0.5);
  const Picture3d after = picture3dOf(*flight.advance(0.0), 0.55);
  for (std::size_t i = 0; i < before.surfaces.size(); ++i) {
    EXPECT_EQ(after.surfaces[i].points, before.surfaces[i].points);
    const Vector3d moved = after.surfaces[i].T_map_points.position_m - before.surfaces[i].T_map_points.position_m;
    EXPECT_NEAR(moved.x(), 0.5 * static_cast<double>(i), 1e-9);
  }
}

TEST(Map3dRendererTest, TheCameraSeesWhatItHasJustMapped) {
  const Picture3d picture = pictureOfFlight(6.0);
  Map3dView view;
  view.width_px = 160;
  view.height_px = 120;
  view.viewpoint.kind = Viewpoint3d::Kind::kCamera;
  const Eye eye = eyeOf(view.viewpoint, picture, 160, 120);
  const DepthBuffer buffer = drawn(picture.surfaces, eye);
  // An ideal camera maps what it measures: the depth of the picture is that of its last frame.
  testing::ExampleFlight flight;
  flight.carryCamera();
  const auto world = flight.advance(6.0);
  const common::DepthImage& depth = world->map3d->frame->depth;
  int compared = 0, alike = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u)
      if (common::isMeasured(depth.at(u, v))) {
        ++compared;
        alike += std::abs(buffer.depth_m(u, v) - depth.at(u, v)) < 0.03F * depth.at(u, v) + 0.05F ? 1 : 0;
      }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(alike, 0.85 * compared);
}

TEST(Map3dRendererTest, TheWholeMapIsInThePictureFromEveryDirection) {
  Picture3d picture;
  picture.surfaces.push_back(surfaceOf(testing::ExampleFlight::room().surface(0.2)));
  for (const auto& [width, height] : {std::pair(320, 240), std::pair(120, 400)})
    for (double azimuth_rad = -3.0; azimuth_rad < 3.2; azimuth_rad += 1.0) {
      Viewpoint3d viewpoint;
      viewpoint.azimuth_rad = azimuth_rad;
      const Eye eye = eyeOf(viewpoint, picture, width, height);
      for (const SurfacePoint& point : *picture.surfaces[0].points) {
        const Vector3d at_m = eye.T_map_eye.inverse() * Vector3d(point.position_m.cast<double>());
        ASSERT_GT(at_m.x(), 0.0);
        const Eigen::Vector2d pixel = eye.lens.pixel(at_m);
        ASSERT_TRUE(pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < width && pixel.y() < height);
      }
    }
}

TEST(Map3dRendererTest, AnOrbitLooksAtItsTargetFromWhereItSays) {
  const Viewpoint3d viewpoint{Viewpoint3d::Kind::kOrbit, 1.0, 2.0, 0.5, 5.0, M_PI / 2, M_PI / 6};
  const Eye eye = eyeOf(viewpoint, {}, 200, 100);
  EXPECT_LT((eye.T_map_eye.position_m - Vector3d(1.0, 2.0 + 5.0 * std::cos(M_PI / 6), 0.5 + 2.5)).norm(), 1e-9);
  EXPECT_LT((eye.T_map_eye.inverse() * Vector3d(1.0, 2.0, 0.5) - Vector3d(5.0, 0.0, 0.0)).norm(), 1e-9);
}

TEST(Map3dRendererTest, WhatASurfaceHidesOfALineIsFaint) {
  Picture3d picture;
  picture.surfaces.push_back(wallAt(2.0, kRed));
  picture.lines.push_back({{Vector3d(3.0, -2.0, 0.0), Vector3d(3.0, 2.0, 0.0)}, Line3dStyle::kTrail});
  picture.camera = PlacedCamera{{}, {320, 240, 150.0, 150.0, 159.5, 119.5}};
  Map3dView view;
  view.viewpoint.kind = Viewpoint3d::Kind::kCamera;
  const common::Image image = renderMap3d(picture, view);
  const Color trail = themeOf(view.scheme).trail;
  // The wall reaches 77 pixels from the middle. Beside it the line is plain.
  const auto distance = [](const Rgb& a, const Rgb& b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  };
  const auto nearest = [&](int u) {
    int least = 1000;
    for (int v = 237; v < 243; ++v)
      least = std::min(least, distance(pixel(image, u, v), {trail.red, trail.green, trail.blue}));
    return least;
  };
  EXPECT_LT(nearest(480), 250);
  EXPECT_GT(nearest(320), 250);
  EXPECT_NE(pixel(image, 320, 239), kRed);
}

TEST(Map3dRendererTest, AnArrowPointsDownAtATarget) {
  Picture3d picture;
  picture.camera = PlacedCamera{{}, {320, 240, 150.0, 150.0, 159.5, 119.5}};
  Map3dView view;
  view.viewpoint.kind = Viewpoint3d::Kind::kCamera;
  const common::Image without = renderMap3d(picture, view);
  picture.targets_map_m = {{3.0, 0.0, 0.0}};
  const common::Image with = renderMap3d(picture, view);
  int above = 0, below = 0;
  for (int v = 0; v < with.height_px; ++v)
    for (int u = 0; u < with.width_px; ++u)
      if (pixel(with, u, v) != pixel(without, u, v)) ++(v < with.height_px / 2 + 3 ? above : below);
  EXPECT_GT(above, 40) << "60 cm at 3 m are 60 pixels, drawn twice as large";
  EXPECT_EQ(below, 0);
}

TEST(Map3dRendererTest, APictureHasAnArrowForWhatIsFoundAndForAPattern) {
  test::Layers layers;
  common::Target found, candidate;
  found.state = common::TargetState::kFound;
  found.position_map_m = {1.0, 2.0, 0.3};
  layers.targets.targets = {candidate, found};
  common::RecognizedObject pattern, door, unsure;
  pattern.what = unsure.what = "H";
  pattern.confirmed = door.confirmed = true;
  pattern.T_map_object.position_m = {3.0, 0.0, 0.0};
  door.what = "door";
  door.passage = common::Passage::kOpen;
  layers.objects = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{{pattern, door, unsure}});
  const Picture3d picture = picture3dOf(layers.world(), 0.5);
  EXPECT_EQ(picture.targets_map_m, (std::vector<Vector3d>{{1.0, 2.0, 0.3}, {3.0, 0.0, 0.0}}));
}

TEST(Map3dRendererTest, AnEmptyMapGivesAPicture) {
  for (const auto kind :
       {Viewpoint3d::Kind::kWhole, Viewpoint3d::Kind::kOrbit, Viewpoint3d::Kind::kFollow, Viewpoint3d::Kind::kCamera}) {
    Map3dView view;
    view.viewpoint.kind = kind;
    EXPECT_EQ(renderMap3d({}, view).rgb.size(), 3U * 640 * 480);
  }
}

TEST(DepthPictureTest, ColoursGoFromRedToBlueWithoutAJump) {
  EXPECT_GT(depthColor(0.8).red, depthColor(0.8).blue);
  EXPECT_GT(depthColor(4.6).blue, depthColor(4.6).red);
  EXPECT_GT(depthColor(2.7).green, 200);
  Color last = depthColor(0.3);
  for (double depth_m = 0.3; depth_m < 6.0; depth_m += 0.01) {
    const Color next = depthColor(depth_m);
    EXPECT_LE(std::abs(next.red - last.red), 6);
    EXPECT_LE(std::abs(next.green - last.green), 6);
    EXPECT_LE(std::abs(next.blue - last.blue), 6);
    last = next;
  }
}

TEST(DepthPictureTest, UnknownIsGreyAndTooFarDark) {
  common::DepthImage depth{
      4, 2, {1.0F, common::DepthImage::kUnknown, common::DepthImage::kTooFar, 3.0F, 1.0F, 1.0F, 1.0F, 1.0F}};
  const common::Image image = depthPicture(depth, 640);
  EXPECT_EQ(image.width_px, 4);
  const auto as = [](Color c) { return Rgb{c.red, c.green, c.blue}; };
  EXPECT_EQ(pixel(image, 0, 0), as(depthColor(1.0)));
  EXPECT_EQ(pixel(image, 1, 0), as(kUnknownDepth));
  EXPECT_EQ(pixel(image, 2, 0), as(kTooFarDepth));
  EXPECT_EQ(pixel(image, 3, 0), as(depthColor(3.0)));
}

}  // namespace
}  // namespace swiftlet::rendering
