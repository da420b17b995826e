// The models of the depth image, one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "rgbd_fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::DepthImage;

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

Spread spreadOf(const DepthImage& image) {
  double sum = 0.0, squares = 0.0, number = 0.0;
  for (const float depth_m : image.depth_m) {
    if (!common::isMeasured(depth_m)) continue;
    sum += static_cast<double>(depth_m);
    squares += static_cast<double>(depth_m) * static_cast<double>(depth_m);
    number += 1.0;
  }
  return {sum / number, std::sqrt(squares / number - sum * sum / (number * number))};
}

TEST(RgbdDepth, NoiseGrowsWithTheSquareOfTheDepth) {
  common::RgbdCameraConfig config = exactCamera();
  config.inverse_depth_noise_1_m = 0.0014;
  for (const double depth_m : {1.0, 2.0, 4.0}) {
    const Spread spread = spreadOf(frameOf(wallAhead(depth_m), config, withoutNoise()).depth);
    EXPECT_NEAR(spread.mean, depth_m, 0.002 * depth_m * depth_m);
    EXPECT_NEAR(spread.deviation, 0.0014 * depth_m * depth_m, 0.05 * 0.0014 * depth_m * depth_m);
  }
}

TEST(RgbdDepth, StepsGrowWithTheSquareOfTheDepth) {
  common::RgbdCameraConfig config = exactCamera();
  config.inverse_depth_step_1_m = 0.00285;
  config.inverse_depth_noise_1_m = 0.003;
  const DepthImage image = frameOf(wallAhead(4.0), config, withoutNoise()).depth;
  const std::set<float> values(image.depth_m.begin(), image.depth_m.end());
  ASSERT_GT(values.size(), 3U);
  float before = 0.0F;
  for (const float value : values) {
    if (before > 0.0F) {
      EXPECT_NEAR(value - before, 0.00285 * value * before, 1e-4);
    }
    before = value;
  }
}

TEST(RgbdDepth, DepthsAreSentInMillimetres) {
  common::RgbdCameraConfig config = exactCamera();
  config.depth_step_m = 0.001;
  for (const float depth_m : frameOf(wallAhead(1.23456), config, withoutNoise()).depth.depth_m)
    EXPECT_NEAR(depth_m, 1.235, 1e-5);
}

TEST(RgbdDepth, ABiasOfTheDisparityGrowsWithTheSquareOfTheDepth) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.inverse_depth_bias_1_m = 0.002;
  for (const double depth_m : {1.0, 3.0})
    EXPECT_NEAR(spreadOf(frameOf(wallAhead(depth_m), exactCamera(), errors).depth).mean,
                depth_m - 0.002 * depth_m * depth_m, 1e-3);
}

TEST(RgbdDepth, TooNearIsUnknownAndBeyondTheRangeIsTooFar) {
  common::RgbdCameraConfig config = exactCamera();
  config.range_min_m = 0.8;
  config.range_max_m = 5.0;
  EXPECT_EQ(count(frameOf(wallAhead(0.7), config, withoutNoise()).depth, DepthImage::kUnknown), 160 * 120);
  EXPECT_EQ(count(frameOf(wallAhead(5.1), config, withoutNoise()).depth, DepthImage::kTooFar), 160 * 120);
  EXPECT_EQ(count(frameOf(WorldModel(wallAhead(70.0)), config, withoutNoise()).depth, DepthImage::kUnknown), 160 * 120)
      << "nothing returns";
}

// A post in front of a wall: what the projector, 7.5 cm to the right, cannot see lies to the left of the post and is as
// wide as the difference of their disparities.
TEST(RgbdDepth, TheProjectorsShadowIsToTheLeftOfNearSurfaces) {
  common::RgbdCameraConfig config = exactCamera();
  config.baseline_m = 0.075;
  WorldModel world = wallAhead(3.0);
  world.shapes.push_back(boxShape("post", {1.0, -0.05, -5.0}, {1.01, 0.05, 5.0}));
  const DepthImage image = frameOf(world, config, withoutNoise()).depth;
  const double focal_px = config.camera().fx_px;
  const int left_edge = static_cast<int>(std::ceil(79.5 - 0.05 * focal_px));
  int shadow = 0;
  for (int u = 0; u < 160; ++u) {
    if (image.at(u, 60) != DepthImage::kUnknown) continue;
    ++shadow;
    EXPECT_LT(u, left_edge);
    EXPECT_GE(u, left_edge - 10);
  }
  EXPECT_NEAR(shadow, focal_px * 0.075 * (1.0 / 1.0 - 1.0 / 3.0), 1.5);
}

TEST(RgbdDepth, SomePixelsAtTheFarSideOfAnEdgeAreHoles) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.edge_hole_rate = 0.5;
  WorldModel world = wallAhead(3.0);
  world.shapes.push_back(boxShape("post", {1.0, -0.05, -5.0}, {1.01, 0.05, 5.0}));
  const DepthImage image = frameOf(world, exactCamera(), errors).depth;
  const int holes = count(image, DepthImage::kUnknown);
  EXPECT_NEAR(holes, 120, 30) << "half of two edges of 120 rows";
  for (const float depth_m : image.depth_m)
    EXPECT_TRUE(depth_m == DepthImage::kUnknown || std::abs(depth_m - 3.0F) < 1e-3F ||
                std::abs(depth_m - 1.0F) < 1e-3F);
}

TEST(RgbdDepth, DarkSurfacesAreSeenFromNearOnly) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.dark_range_m = 2.0;
  const auto seenAhead = [&](double distance_m, float grey) {
    const DepthImage image = frameOf(wallAhead(distance_m, Color::Constant(grey)), exactCamera(), errors).depth;
    return common::isMeasured(image.at(80, 60));
  };
  EXPECT_TRUE(seenAhead(1.9, 0.04F));
  EXPECT_FALSE(seenAhead(2.1, 0.04F));
  EXPECT_TRUE(seenAhead(3.9, 0.16F)) << "four times as bright, twice as far";
  EXPECT_FALSE(seenAhead(4.1, 0.16F));
}

TEST(RgbdDepth, SurfacesAtGlancingAnglesHaveNone) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.glancing_deg = 75.0;
  WorldModel world;
  world.shapes = {boxShape("floor", {-30.0, -30.0, -1.1}, {30.0, 30.0, -1.0})};
  const common::RgbdFrame frame = frameOf(world, exactCamera(), errors);
  for (int v = 61; v < 120; ++v) {
    const Eigen::Vector3d direction = frame.camera.point_camera_m(80, v, 1.0).normalized();
    const double incidence_deg = std::acos(-direction.z()) / common::kRadPerDeg;
    if (std::abs(incidence_deg - 75.0) < 0.5) continue;
    EXPECT_EQ(common::isMeasured(frame.depth.at(80, v)), incidence_deg < 75.0) << v;
  }
}

// The autonomy is told the focal length of the data sheet.
TEST(RgbdDepth, ATrueFocalLengthOfItsOwnBendsTheFloor) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.focal_share = 1.02;
  const WorldModel world = boxRoom();
  const common::Pose3 pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5}};
  const common::RgbdFrame exact = frameOf(world, exactCamera(), withoutNoise(), pose);
  const common::RgbdFrame longer = frameOf(world, exactCamera(), errors, pose);
  EXPECT_EQ(longer.camera.fx_px, exact.camera.fx_px);
  const auto floorAt = [](const common::RgbdFrame& frame) {
    return frame.camera.point_camera_m(80, 115, static_cast<double>(frame.depth.at(80, 115))).z();
  };
  EXPECT_NEAR(floorAt(exact), -1.5, 1e-3);
  EXPECT_NEAR(floorAt(longer), -1.5 * 1.02, 3e-3);
}

}  // namespace
}  // namespace swiftlet::simulation
