#include "mapping3d/voxels/point_voxels.hpp"

#include <gtest/gtest.h>

namespace swiftlet::mapping3d {
namespace {

/// One in each of so many blocks.
std::vector<common::SurfacePoint> scattered(int points) {
  std::vector<common::SurfacePoint> cloud(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i) cloud[static_cast<std::size_t>(i)].position_m.x() = static_cast<float>(i);
  return cloud;
}

TEST(PointVoxels, FillNoMoreBlocksThanAllowed) {
  const PointVoxels fits = voxelsAround(scattered(100), 0.1, 100);
  EXPECT_FALSE(fits.full);
  EXPECT_EQ(fits.map.blockCount(), 100U);
  const PointVoxels full = voxelsAround(scattered(200), 0.1, 100);
  EXPECT_TRUE(full.full);
  EXPECT_LE(full.map.blockCount(), 101U);
  EXPECT_FALSE(voxelsAround(scattered(200), 1.0, 100).full) << "the remedy";
}

TEST(PointVoxels, TheLastPointMayBeOneTooMany) { EXPECT_TRUE(voxelsAround(scattered(101), 0.1, 100).full); }

}  // namespace
}  // namespace swiftlet::mapping3d
