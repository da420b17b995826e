// Corners against the slow obvious way, and their spread over the picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "common/small_matrices.hpp"
#include "vision/corners.hpp"

namespace swiftlet::vision {
namespace {

GrayImage noise(int width_px, int height_px, std::uint64_t seed) {
  common::RandomStream random(seed, "picture");
  GrayImage image{width_px, height_px, {}};
  for (int i = 0; i < width_px * height_px; ++i)
    image.values.push_back(static_cast<std::uint8_t>(random.uniform(0.0, 256.0)));
  return image;
}

/// A white square on black, with its corners at (left, top) and so on.
GrayImage square(int width_px, int height_px, int left, int top, int side_px) {
  GrayImage image{width_px, height_px, {}};
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u)
      image.values.push_back(u >= left && u < left + side_px && v >= top && v < top + side_px ? 200 : 20);
  return image;
}

/// The smaller eigenvalue of the gradients' moments over 5x5 pixels, by the general decomposition.
double contrastByDecomposition(const GrayImage& image, int u, int v) {
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (int dv = -2; dv <= 2; ++dv)
    for (int du = -2; du <= 2; ++du) {
      const Eigen::Vector2d gradient(0.5 * (image.at(u + du + 1, v + dv) - image.at(u + du - 1, v + dv)),
                                     0.5 * (image.at(u + du, v + dv + 1) - image.at(u + du, v + dv - 1)));
      moments += gradient * gradient.transpose() / 25.0;
    }
  return std::sqrt(common::symmetricEigenvalues(moments)[0]);
}

TEST(Corners, ContrastIsTheSmallerEigenvalueAtEveryPixel) {
  const GrayImage image = noise(40, 30, 1);
  const std::vector<float> contrast = cornerContrast(image);
  for (int v = 3; v < 27; ++v)
    for (int u = 3; u < 37; ++u)
      ASSERT_NEAR(static_cast<double>(contrast[static_cast<std::size_t>(v * 40 + u)]),
                  contrastByDecomposition(image, u, v), 1e-3)
          << u << ", " << v;
}

TEST(Corners, FindsTheFourOfASquareAndNoEdge) {
  const std::vector<Corner> corners = findCorners(square(80, 60, 30, 20, 24), {});
  ASSERT_EQ(corners.size(), 4u);
  for (const Corner& corner : corners) {
    EXPECT_NEAR(std::abs(corner.pixel.x() - 41.5), 12.0, 1.5);
    EXPECT_NEAR(std::abs(corner.pixel.y() - 31.5), 12.0, 1.5);
  }
}

TEST(Corners, FlatAndSmallPicturesHaveNone) {
  EXPECT_TRUE(findCorners({64, 48, std::vector<std::uint8_t>(64 * 48, 90)}, {}).empty());
  EXPECT_TRUE(findCorners(noise(7, 7, 1), {}).empty());
  EXPECT_TRUE(findCorners({}, {}).empty());
}

TEST(Corners, TheirNumberIsBoundedAndEveryCellGivesItsStrongestFirst) {
  CornerConfig config;
  config.greatest_number = 60;
  config.cell_px = 16;
  const std::vector<Corner> corners = findCorners(noise(160, 96, 2), config);
  ASSERT_EQ(corners.size(), 60u);
  std::vector<int> in_cell(60, 0);
  for (const Corner& corner : corners) {
    const int u = static_cast<int>(std::lround(corner.pixel.x())) / 16,
              v = static_cast<int>(std::lround(corner.pixel.y())) / 16;
    ++in_cell[static_cast<std::size_t>(v * 10 + u)];
  }
  EXPECT_THAT(in_cell, testing::Each(1));
}

TEST(Corners, MoveWithThePicture) {
  const std::vector<Corner> here = findCorners(square(80, 60, 30, 20, 24), {});
  const std::vector<Corner> there = findCorners(square(80, 60, 33, 18, 24), {});
  ASSERT_EQ(here.size(), there.size());
  for (const Corner& corner : here)
    EXPECT_THAT(there, testing::Contains(testing::Truly([&](const Corner& moved) {
                  return (moved.pixel - corner.pixel - Eigen::Vector2d(3, -2)).norm() < 1e-9;
                })));
}

}  // namespace
}  // namespace swiftlet::vision
