// PointsByCube finds what a search through all points finds.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "mapping3d/cloud/large_cubes.hpp"

namespace swiftlet::mapping3d {
namespace {

TEST(PointsByCube, FindsWhatASearchThroughAllPointsFinds) {
  constexpr float kSide_m = 0.1F;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate_m(-0.6F, 0.6F);  // On both sides of the origin.
  const auto somewhere = [&] {
    common::SurfacePoint point;
    for (float& value : point.position_m) value = coordinate_m(random);
    return point;
  };
  std::vector<common::SurfacePoint> points(400);
  std::generate(points.begin(), points.end(), somewhere);
  const PointsByCube by_cube(points, kSide_m);
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const common::SurfacePoint place = somewhere();
    const bool expected = std::any_of(points.begin(), points.end(), [&](const common::SurfacePoint& point) {
      return (point.position_m - place.position_m).norm() < kSide_m;
    });
    EXPECT_EQ(by_cube.anyNear(place), expected) << place.position_m.transpose();
    near += expected ? 1 : 0;
  }
  EXPECT_GT(near, 300);
  EXPECT_LT(near, 1900);
}

TEST(PointsByCube, WithoutPointsNothingIsNear) {
  const std::vector<common::SurfacePoint> none;
  EXPECT_FALSE(PointsByCube(none, 0.1F).anyNear(common::SurfacePoint{}));
}

}  // namespace
}  // namespace swiftlet::mapping3d
