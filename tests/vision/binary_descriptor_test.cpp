#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "vision/binary_descriptor.hpp"

namespace swiftlet::vision {
namespace {

/// Smooth random texture: mean of random blocks of several sizes.
GrayImage texture(int side_px, std::uint64_t seed) {
  GrayImage image{side_px, side_px, std::vector<std::uint8_t>(static_cast<std::size_t>(side_px * side_px), 0)};
  common::RandomStream random(seed, "texture");
  for (int i = 0; i < 400; ++i) {
    const int u = static_cast<int>(random.uniform(0.0, side_px)), v = static_cast<int>(random.uniform(0.0, side_px));
    const int size_px = static_cast<int>(random.uniform(3.0, 20.0));
    const auto value = static_cast<std::uint8_t>(random.uniform(0.0, 255.0));
    for (int y = v; y < std::min(v + size_px, side_px); ++y)
      for (int x = u; x < std::min(u + size_px, side_px); ++x)
        image.values[static_cast<std::size_t>(y * side_px + x)] = value;
  }
  return image;
}

/// A quarter turn: the pixel (u, v) goes to (side - 1 - v, u).
GrayImage turned(const GrayImage& image) {
  GrayImage result = image;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u)
      result.values[static_cast<std::size_t>(u * image.width_px + (image.width_px - 1 - v))] =
          static_cast<std::uint8_t>(image.at(u, v));
  return result;
}

TEST(BinaryDescriptor, RecognizesATurnedPatchAmongOthers) {
  const GrayImage image = texture(160, 3), quarter = turned(image);
  std::vector<Eigen::Vector2d> pixels, turned_pixels;
  for (int v = 30; v < 130; v += 20)
    for (int u = 30; u < 130; u += 20) {
      pixels.emplace_back(u, v);
      turned_pixels.emplace_back(159 - v, u);
    }
  const auto here = describePatches(image, pixels), there = describePatches(quarter, turned_pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t j = 0; j < pixels.size(); ++j) {
      if (i == j) continue;
      EXPECT_LT(here[i]->distance(*there[i]), here[i]->distance(*there[j])) << i << ", " << j;
    }
}

TEST(BinaryDescriptor, NoneWhereThePatchLeavesThePicture) {
  const std::vector<Eigen::Vector2d> pixels{{3.0, 80.0}, {80.0, 80.0}, {80.0, 157.0}};
  const auto described = describePatches(texture(160, 3), pixels);
  EXPECT_FALSE(described[0]);
  EXPECT_TRUE(described[1]);
  EXPECT_FALSE(described[2]);
}

}  // namespace
}  // namespace swiftlet::vision
