// The uncertainty of features: the mixture over the neighbourhood, and the moments of a point against samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "vision/features.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::vision {
namespace {

common::DepthImage flat(int width_px, int height_px, float depth_m) {
  return {width_px, height_px, std::vector<float>(static_cast<std::size_t>(width_px * height_px), depth_m)};
}

float& at(common::DepthImage& depth, int u, int v) {
  return depth.depth_m[static_cast<std::size_t>(v * depth.width_px + u)];
}

TEST(DepthMixture, OnAPlaneAcrossTheViewIsTheNoiseAlone) {
  const DepthNoiseConfig noise;
  const auto mixture = depthMixture(flat(9, 9, 2.0F), 4, 4, noise);
  ASSERT_TRUE(mixture);
  EXPECT_NEAR(mixture->mean_m, 2.0, 1e-6);
  EXPECT_NEAR(std::sqrt(mixture->variance_m2), 1.45e-3 * 4.0, 1e-7);
}

TEST(DepthMixture, AtAnEdgeSpansBothSurfaces) {
  common::DepthImage depth = flat(9, 9, 2.0F);
  for (int v = 0; v < 9; ++v)
    for (int u = 5; u < 9; ++u) at(depth, u, v) = 3.0F;
  const auto mixture = depthMixture(depth, 4, 4, {});
  ASSERT_TRUE(mixture);
  // A quarter of the weight is on the column at 3 m.
  EXPECT_NEAR(mixture->mean_m, 2.25, 1e-6);
  EXPECT_NEAR(mixture->variance_m2, 0.25 * 0.75 * 1.0, 2e-4);
}

TEST(DepthMixture, HasTheMomentsOfSamples) {
  common::DepthImage depth = flat(9, 9, 2.0F);
  common::RandomStream random(5, "mixture");
  for (float& depth_m : depth.depth_m) depth_m += static_cast<float>(random.uniform(0.0, 0.1));
  const DepthNoiseConfig noise;
  double mean_m = 0.0, second_m2 = 0.0;
  constexpr int kSamples = 200'000;
  for (int i = 0; i < kSamples; ++i) {
    // The sum of two bits, less one, has the weights 1, 2, 1 of the neighbours.
    const auto offset = [&] { return (random.chance(0.5) ? 1 : 0) - (random.chance(0.5) ? 1 : 0); };
    const auto pixel_m = static_cast<double>(at(depth, 4 + offset(), 4 + offset()));
    const double sample_m = pixel_m + random.gaussian(noise.sigma_m(pixel_m));
    mean_m += sample_m / kSamples;
    second_m2 += sample_m * sample_m / kSamples;
  }
  const auto mixture = depthMixture(depth, 4, 4, noise);
  ASSERT_TRUE(mixture);
  EXPECT_NEAR(mixture->mean_m, mean_m, 3e-4);
  EXPECT_NEAR(mixture->variance_m2, second_m2 - mean_m * mean_m, 0.02 * mixture->variance_m2);
}

TEST(DepthMixture, NeedsThePixelAndMostOfItsNeighbours) {
  common::DepthImage hole = flat(9, 9, 2.0F);
  at(hole, 4, 4) = common::DepthImage::kUnknown;
  EXPECT_FALSE(depthMixture(hole, 4, 4, {}));
  common::DepthImage sparse = flat(9, 9, 2.0F);
  for (const int v : {3, 4, 5})
    for (const int u : {3, 5}) at(sparse, u, v) = common::DepthImage::kTooFar;
  EXPECT_FALSE(depthMixture(sparse, 4, 4, {}));
  EXPECT_FALSE(depthMixture(flat(9, 9, 2.0F), 0, 4, {}));
}

TEST(GaussianPoint, HasTheMomentsOfSamples) {
  const common::PinholeCamera camera{320, 240, 290.0, 280.0, 160.0, 118.0};
  const Eigen::Vector2d pixel(250.0, 60.0);
  const DepthDistribution depth{2.5, 0.02 * 0.02};
  const double pixel_sigma_px = 3.0;
  common::RandomStream random(7, "samples");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 200'000;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d point =
        camera.point_camera_m(pixel.x() + random.gaussian(pixel_sigma_px), pixel.y() + random.gaussian(pixel_sigma_px),
                              depth.mean_m + random.gaussian(std::sqrt(depth.variance_m2)));
    mean += point / kSamples;
    second += point * point.transpose() / kSamples;
  }
  const GaussianPoint gaussian = gaussianPoint(camera, pixel, pixel_sigma_px, depth);
  EXPECT_NEAR((gaussian.mean_camera_m - mean).norm(), 0.0, 3e-4);
  const Eigen::Matrix3d covariance = second - mean * mean.transpose();
  EXPECT_LT((gaussian.covariance_camera_m2 - covariance).norm(), 0.02 * covariance.norm());
}

TEST(HalvedDepth, MakesNoPointBetweenTwoSurfaces) {
  common::DepthImage depth = flat(4, 2, 1.0F);
  at(depth, 0, 0) = 1.02F;
  at(depth, 3, 0) = at(depth, 3, 1) = 2.0F;
  const common::DepthImage half = halved(depth);
  EXPECT_FLOAT_EQ(half.at(0, 0), 1.005F);
  EXPECT_FLOAT_EQ(half.at(1, 0), 1.0F);
}

TEST(HalvedDepth, ASingleMeasuredPixelIsNone) {
  common::DepthImage depth = flat(2, 2, common::DepthImage::kTooFar);
  EXPECT_EQ(halved(depth).at(0, 0), common::DepthImage::kTooFar);
  at(depth, 0, 0) = 1.0F;
  EXPECT_EQ(halved(depth).at(0, 0), common::DepthImage::kUnknown);
}

TEST(HalvedCamera, SeesTheSamePointAtTheMiddleOfItsFourPixels) {
  const common::PinholeCamera camera{320, 240, 290.0, 280.0, 160.3, 118.8};
  const Eigen::Vector3d point = camera.point_camera_m(100.5, 60.5, 2.0);  // Between pixels 100, 101 and 60, 61.
  EXPECT_NEAR((halved(camera).pixel(point) - Eigen::Vector2d(50.0, 30.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace swiftlet::vision
