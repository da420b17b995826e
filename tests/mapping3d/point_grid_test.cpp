// Points of a wall that was seen from near and from afar.
#include "mapping3d/model/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::mapping3d {
namespace {

constexpr double kCube_m = 0.02;

/// A wall at x = `depth_m`, 1 m by 1 m, seen with that noise.
std::vector<SeenPoint> wall(double depth_m, double sigma_m, common::RandomStream& random, double from_y_m = -0.5) {
  std::vector<SeenPoint> points;
  for (double y = from_y_m; y < from_y_m + 1.0; y += 0.02)
    for (double z = -0.5; z < 0.5; z += 0.02) {
      SeenPoint point{Eigen::Vector3d(depth_m + random.gaussian(sigma_m), y, z).cast<float>(),
                      -Eigen::Vector3f::UnitX()};
      point.weight = static_cast<float>(1.0 / (sigma_m * sigma_m));
      points.push_back(point);
    }
  return points;
}

double p95OffPlane_m(const WeightedPoints& grid, double depth_m) {
  std::vector<double> off_m;
  for (const common::SurfacePoint& point : *grid.points)
    off_m.push_back(std::abs(static_cast<double>(point.position_m.x()) - depth_m));
  std::sort(off_m.begin(), off_m.end());
  return off_m[off_m.size() * 95 / 100];
}

/// The share of places of the wall, 5 cm apart, with a point within 10 cm.
double covered(const WeightedPoints& grid, double depth_m, double from_y_m) {
  int places = 0, near = 0;
  for (double y = from_y_m; y < from_y_m + 1.0; y += 0.05)
    for (double z = -0.5; z < 0.5; z += 0.05, ++places)
      near += std::any_of(grid.points->begin(), grid.points->end(), [&](const common::SurfacePoint& point) {
        return (point.position_m - Eigen::Vector3d(depth_m, y, z).cast<float>()).norm() < 0.1F;
      });
  return static_cast<double>(near) / places;
}

TEST(PointGrid, AveragesNoisyPointsInLargerCubes) {
  common::RandomStream random(1, "wall");
  PointGrid grid(kCube_m);
  for (int frame = 0; frame < 10; ++frame) grid.add(wall(4.5, 0.03, random), {});
  const WeightedPoints points = grid.points();
  EXPECT_EQ(points.fine, 0U);
  EXPECT_LT(points.points->size(), 1000U);
  EXPECT_LT(p95OffPlane_m(points, 4.5), 0.06) << "two standard deviations of a single depth";
  EXPECT_GT(covered(points, 4.5, -0.5), 0.99);
}

TEST(PointGrid, WhatWasSeenWellIsNotSpoiledFromAfar) {
  common::RandomStream random(2, "wall");
  PointGrid grid(kCube_m);
  grid.add(wall(2.0, 0.005, random), {});
  const std::size_t well = grid.points().points->size();
  for (int frame = 0; frame < 10; ++frame) grid.add(wall(2.0, 0.03, random), {});
  EXPECT_EQ(grid.points().points->size(), well);
  EXPECT_LT(p95OffPlane_m(grid.points(), 2.0), 0.012);
  for (int frame = 0; frame < 10; ++frame) grid.add(wall(2.0, 0.03, random, 1.0), {});
  EXPECT_GT(covered(grid.points(), 2.0, 1.0), 0.99) << "beside it there is nothing better";
}

TEST(PointGrid, GoesOnWhereItWasLeft) {
  common::RandomStream random(3, "wall");
  const std::vector<SeenPoint> first = wall(2.0, 0.005, random), second = wall(4.0, 0.03, random),
                               third = wall(4.0, 0.03, random);
  PointGrid whole(kCube_m), left(kCube_m), again(kCube_m);
  for (const auto& points : {first, second}) {
    whole.add(points, {});
    left.add(points, {});
  }
  again.add(left.points());
  whole.add(third, {});
  again.add(third, {});
  const WeightedPoints a = whole.points(), b = again.points();
  ASSERT_EQ(a.fine, b.fine);
  for (std::size_t i = 0; i < a.fine; ++i) {
    EXPECT_LT(((*a.points)[i].position_m - (*b.points)[i].position_m).norm(), 1e-4F);
    EXPECT_NEAR(a.weights[i], b.weights[i], 1e-3F * a.weights[i]);
  }
  const auto noisy = static_cast<double>(a.points->size() - a.fine);
  EXPECT_NEAR(noisy, static_cast<double>(b.points->size() - b.fine), 0.1 * noisy)
      << "large cubes that were left out when it was left begin anew";
}

}  // namespace
}  // namespace swiftlet::mapping3d
