// The parts of the least-squares matchers, each against a slow and simple computation.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/interpolated_field.hpp"
#include "perception/scan_matching/oriented_points.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

TEST(InterpolatedField, TheSlopeIsTheDerivative) {
  common::RandomStream random(1, "slope");
  LikelihoodField field(0.02, 0.04);
  field.draw(contourOf(test::scanAt(test::flat(), {}, 0).points_level_m, 0.3, 20.0));
  int supported = 0;
  for (int trial = 0; trial < 200'000 && supported < 1000; ++trial) {
    const Eigen::Vector2d p(random.uniform(-3.0, 9.0), random.uniform(-4.0, 6.0));
    const auto sample = sampleField(field, p);
    if (!sample) continue;
    // Within one cell the value is bilinear, so that a difference along an axis is exact.
    constexpr double kStep_m = 1e-5;
    const auto right = sampleField(field, p + Eigen::Vector2d(kStep_m, 0.0));
    const auto up = sampleField(field, p + Eigen::Vector2d(0.0, kStep_m));
    const auto inCell = [&](int axis) {
      const double u = p[axis] / field.resolution_m() - 0.5;
      return u - std::floor(u) < 0.99;
    };
    if (!right || !up || !inCell(0) || !inCell(1)) continue;
    EXPECT_NEAR((right->value - sample->value) / kStep_m, sample->slope_1_m.x(), 1e-5);
    EXPECT_NEAR((up->value - sample->value) / kStep_m, sample->slope_1_m.y(), 1e-5);
    ++supported;
  }
  EXPECT_EQ(supported, 1000);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {nan, 1e300, -1e300, 1e4, -1e4}) EXPECT_FALSE(sampleField(field, {x, 0.0}));
}

TEST(InterpolatedField, EqualsTheCellAtItsMiddle) {
  LikelihoodField field(0.01, 0.02);
  const std::vector<ContourSegment> wall{{Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 0.3)}};
  field.draw(wall);
  for (int i = 0; i < 100; ++i) {
    const int x = i - field.beginX(), y = static_cast<int>(0.3 * i) - field.beginY();
    const auto sample = sampleField(field, {(i + 0.5) * 0.01, (static_cast<int>(0.3 * i) + 0.5) * 0.01});
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->value, field.at(x, y) / 255.0, 1e-9);
  }
}

/// A scan that saw walls: points with normals as the matcher makes them.
std::vector<OrientedPoint> seenFrom(const Pose2& pose, std::uint64_t frame) {
  return orientedPoints(test::scanAt(test::flat(), pose, frame), 0, 0.3, 20.0);
}

TEST(ContourNormals, EqualTheNormalsOfTheWalls) {
  const Pose2 pose{0.3, 0.2, 0.5};
  const test::PlanarWorld world = test::flat();
  const auto points = seenFrom(pose, 3);
  ASSERT_GT(points.size(), 800U);
  double off2_point_m2 = 0.0, off2_foot_m2 = 0.0;
  int wrong = 0;
  for (const OrientedPoint& p : points) {
    EXPECT_LT(p.normal.dot(p.point_m), 0.0F);  // Towards the laser.
    EXPECT_NEAR(p.normal.norm(), 1.0F, 1e-4F);
    const Eigen::Vector2d foot = pose * p.foot_m.cast<double>(), point = pose * p.point_m.cast<double>();
    const Eigen::Vector2d normal = Eigen::Rotation2Dd(pose.yaw_rad) * p.normal.cast<double>();
    double best = 0.0, nearest_m = 0.05;
    for (const test::Wall& wall : world.walls) {
      const Eigen::Vector2d edge = (wall.b_m - wall.a_m).normalized();
      if (test::PlanarWorld{{wall}}.distanceToWall(foot) > nearest_m) continue;
      best = std::max(best, std::abs(normal.dot(Eigen::Vector2d(-edge.y(), edge.x()))));
    }
    if (best < 0.98) ++wrong;
    off2_point_m2 += std::pow(world.distanceToWall(point), 2.0);
    off2_foot_m2 += std::pow(world.distanceToWall(foot), 2.0);
  }
  EXPECT_LT(wrong, static_cast<int>(points.size()) / 50);
  EXPECT_LT(off2_foot_m2, 0.3 * off2_point_m2);  // The line has the noise of many beams.
}

TEST(ContourNormals, DoNotExistForLonePointsAndEmptyScans) {
  ProjectedScan scan;
  EXPECT_TRUE(orientedPoints(scan, 0, 0.3, 20.0).empty());
  EXPECT_TRUE(orientedPoints(scan, 100, 0.3, 20.0).empty());
  scan.points_level_m = {{1.0F, 0.0F}};
  EXPECT_TRUE(orientedPoints(scan, 0, 0.3, 20.0).empty());
  scan.points_level_m = {{1.0F, 0.0F}, {3.0F, 1.0F}, {1.0F, 2.0F}, {-4.0F, 2.0F}};
  EXPECT_TRUE(orientedPoints(scan, 2, 0.3, 20.0).empty());
}

TEST(OrientedPoints, FindTheNearestPoint) {
  common::RandomStream random(2, "nearest");
  OrientedPoints points;
  std::vector<OrientedPoint> all;
  for (int i = 0; i < 600; ++i) {
    const double angle = random.uniform(-3.0, 3.0);
    // Farther apart than the spacing and not on one surface, so that no point is removed or added.
    const Eigen::Vector2f at(static_cast<float>(random.uniform(-4.0, 4.0)),
                             static_cast<float>(random.uniform(-2.0, 2.0)));
    if (!all.empty() && (at - all.back().foot_m).norm() < 0.5F) continue;
    all.push_back({at, {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}, at, 0.0F});
  }
  points.add(all, {}, 0.3);
  points.sort();
  int found = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Vector2d at(random.uniform(-5.0, 5.0), random.uniform(-3.0, 3.0));
    const double angle = random.uniform(-3.0, 3.0), radius_m = random.uniform(0.02, 0.6);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    double nearest_m = radius_m;
    for (const OrientedPoint& p : all)
      if (p.normal.cast<double>().dot(normal) >= 0.7071)
        nearest_m = std::min(nearest_m, (p.foot_m.cast<double>() - at).norm());
    const int index = points.nearest(at, normal, radius_m);
    ASSERT_EQ(index != OrientedPoints::kNone, nearest_m < radius_m);
    if (index == OrientedPoints::kNone) continue;
    EXPECT_NEAR((points.point_m(index) - at).norm(), nearest_m, 1e-12);
    ++found;
  }
  EXPECT_GT(found, 500);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {nan, 1e300, -1e300})
    EXPECT_EQ(points.nearest({x, 0.0}, {1.0, 0.0}, 0.5), OrientedPoints::kNone);
}

}  // namespace
}  // namespace swiftlet::perception
