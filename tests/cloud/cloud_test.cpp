// The cloud of a 3D map: one point a cube, without specks, in `map`.
#include "mapping3d/cloud/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace swiftlet::mapping3d {
namespace {

using common::SurfacePoint;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Of points in one submap at the origin of the map.
std::vector<SurfacePoint> cleanCloud(const std::vector<SurfacePoint>& points, const CloudConfig& config = {}) {
  common::KeyPoses keys;
  keys.keys.resize(1);
  common::Submap3d submap;
  submap.points = std::make_shared<const std::vector<SurfacePoint>>(points);
  return cloudOf({submap}, keys, config);
}

/// A wall of 2 m x 1.5 m at x = 1, seen from the origin, several points a cube.
std::vector<SurfacePoint> wall(std::mt19937& random, double noise_m = 0.003) {
  std::uniform_real_distribution<float> y(-1.0F, 1.0F), z(0.0F, 1.5F);
  std::normal_distribution<float> noise(0.0F, static_cast<float>(noise_m));
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 30'000; ++i)
    points.push_back({Vector3f(1.013F + noise(random), y(random), z(random)), -Vector3f::UnitX(), {200, 100, 50}});
  return points;
}

using Cube = std::tuple<int, int, int>;

Cube cubeOf(const Vector3f& p, float cube_m) {
  const auto index = [&](float value) { return static_cast<int>(std::floor(value / cube_m)); };
  return {index(p.x()), index(p.y()), index(p.z())};
}

TEST(CleanCloudTest, HasNoMorePointsThanItMay) {
  std::mt19937 random(1);
  CloudConfig config;
  const std::size_t all = cleanCloud(wall(random), config).size();
  config.points_max = all / 5;
  const std::size_t some = cleanCloud(wall(random), config).size();
  EXPECT_LE(some, config.points_max);
  EXPECT_GT(some, config.points_max / 3) << "no more is left out than must be";
}

TEST(CleanCloudTest, TheQuickOneKeepsSpecks) {
  std::mt19937 random(1);
  std::vector<SurfacePoint> points = wall(random);
  const std::size_t without = cleanCloud(points).size();
  points.push_back({Vector3f(-3.0F, 0.0F, 0.0F), Vector3f::Zero(), {}});
  CloudConfig quick;
  quick.neighbours = 0;
  const std::vector<SurfacePoint> cloud = cleanCloud(points, quick);
  EXPECT_GT(cloud.size(), without);
  EXPECT_TRUE(std::any_of(cloud.begin(), cloud.end(), [](const SurfacePoint& p) { return p.position_m.x() < 0.0F; }));
}

TEST(CleanCloudTest, KeepsTheMeanOfEachCube) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-0.2F, 0.2F);
  std::uniform_int_distribution<int> channel(0, 255);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 4000; ++i)
    points.push_back({Vector3f(place(random), place(random), place(random)),
                      Vector3f(place(random), place(random), 1.0F).normalized(),
                      {static_cast<std::uint8_t>(channel(random)), static_cast<std::uint8_t>(channel(random)), 7}});
  CloudConfig config;
  config.cube_m = 0.05;
  config.deviations = 1000.0;  // Nothing is an outlier.
  struct Sum {
    Vector3f position = Vector3f::Zero(), normal = Vector3f::Zero();
    std::array<int, 3> rgb{};
    int count = 0;
  };
  std::map<Cube, Sum> sums;
  for (const SurfacePoint& point : points) {
    Sum& sum = sums[cubeOf(point.position_m, 0.05F)];
    sum.position += point.position_m;
    sum.normal += point.normal;
    for (std::size_t i = 0; i < 3; ++i) sum.rgb[i] += point.rgb[i];
    ++sum.count;
  }
  const std::vector<SurfacePoint> kept = cleanCloud(points, config);
  ASSERT_EQ(kept.size(), sums.size());
  for (const SurfacePoint& point : kept) {
    const auto it = sums.find(cubeOf(point.position_m, 0.05F));
    ASSERT_NE(it, sums.end());
    const Sum& sum = it->second;
    EXPECT_LT((point.position_m - sum.position / static_cast<float>(sum.count)).norm(), 1e-5F);
    EXPECT_LT((point.normal - sum.normal.normalized()).norm(), 1e-4F);
    for (std::size_t i = 0; i < 3; ++i) {
      const int mean = sum.rgb[i] / sum.count;
      EXPECT_NEAR(point.rgb[i], mean, 1);
    }
  }
}

TEST(CleanCloudTest, RemovesSpecksAndKeepsTheWall) {
  std::mt19937 random(2);
  std::vector<SurfacePoint> points = wall(random);
  const std::size_t alone = cleanCloud(points).size();
  for (int i = 0; i < 40; ++i)
    points.push_back({Vector3f(0.2F + 0.01F * static_cast<float>(i % 5), -1.0F + 0.05F * static_cast<float>(i), 0.7F),
                      Vector3f::UnitY(),
                      {9, 9, 9}});
  std::size_t specks = 0;
  const std::vector<SurfacePoint> kept = cleanCloud(points);
  for (const SurfacePoint& point : kept) specks += point.position_m.x() < 0.5F ? 1 : 0;
  EXPECT_LE(specks, 2U);
  EXPECT_GT(kept.size(), 0.97 * static_cast<double>(alone));
}

/// Large clouds are searched part by part; a speck at the border of two parts is one all the same, and a wall there
/// none.
TEST(CleanCloudTest, ALargeCloudIsCleanedAsASmallOneIs) {
  std::vector<SurfacePoint> points;
  for (int y = 0; y < 560; ++y)
    for (int x = 0; x < 560; ++x)
      points.push_back({Vector3f(0.02F * static_cast<float>(x) + 0.01F, 0.02F * static_cast<float>(y) + 0.01F, 0.01F),
                        Vector3f::UnitZ(),
                        {1, 2, 3}});
  const std::size_t floor = points.size();
  for (int i = 0; i < 100; ++i)
    points.push_back({Vector3f(0.14F * static_cast<float>(i), 5.0F, 1.0F), Vector3f::UnitZ(), {9, 9, 9}});
  CloudConfig config;
  config.deviations = 20.0;  // Corners have their neighbours on one side.
  const std::vector<SurfacePoint> kept = cleanCloud(points, config);
  EXPECT_EQ(kept.size(), floor);
  for (const SurfacePoint& point : kept) ASSERT_LT(point.position_m.z(), 0.5F);
}

TEST(CleanCloudTest, MissingNormalsAreThoseOfThePlaneOnTheSideOfTheKnownOnes) {
  std::mt19937 random(3);
  std::vector<SurfacePoint> points = wall(random);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position_m.x() = 1.013F;
    // In every third column of cubes none is known.
    if (static_cast<int>(std::floor(points[i].position_m.y() / 0.02F)) % 3 == 0) points[i].normal.setZero();
  }
  for (const SurfacePoint& point : cleanCloud(points)) ASSERT_GT(-point.normal.x(), 0.95F) << point.normal.transpose();
  for (SurfacePoint& point : points) point.normal.setZero();
  for (const SurfacePoint& point : cleanCloud(points)) ASSERT_TRUE(point.normal.isZero());
}

TEST(CleanCloudTest, AWallSeenFromBothSidesHasNoNormalWithoutNan) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 60; ++i)
    for (const float side : {-1.0F, 1.0F})
      points.push_back(
          {Vector3f(1.005F, 0.02F * static_cast<float>(i) + 0.01F, 0.01F), Vector3f(side, 0.0F, 0.0F), {1, 2, 3}});
  CloudConfig config;
  config.deviations = 1000.0;  // The ends of the row have neighbours on one side only.
  const std::vector<SurfacePoint> kept = cleanCloud(points, config);
  EXPECT_EQ(kept.size(), 60U);
  for (const SurfacePoint& point : kept) EXPECT_TRUE(point.normal.isZero());
}

TEST(CleanCloudTest, PointsThatAreNotFiniteAndFewPointsDoNoHarm) {
  const float nan = std::nanf("");
  EXPECT_TRUE(cleanCloud({}).empty());
  const std::vector<SurfacePoint> kept =
      cleanCloud({{{nan, 0, 0}, {0, 0, 1}, {1, 2, 3}},
                  {{0, 1, std::numeric_limits<float>::infinity()}, {0, 0, 1}, {1, 2, 3}},
                  {{1e30F, 0, 0}, {0, 0, 1}, {1, 2, 3}},
                  {{0, 0, 1}, {nan, 0, 1}, {1, 2, 3}},
                  {{3, 4, 5}, {0, 0, 1}, {1, 2, 3}}});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_LT((kept[0].position_m - Vector3f(3, 4, 5)).norm(), 1e-6F);
}

TEST(CleanCloudTest, ABuildingWithMoreCubesThanPclCanCountIsThinnedAllTheSame) {
  // 300 m x 300 m x 20 m in cubes of 2 cm are 2e11; PCL alone would return every point.
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 300; ++i)
    for (int k = 0; k < 10; ++k)
      points.push_back({Vector3f(static_cast<float>(i), 300.0F - static_cast<float>(i), 0.06F * static_cast<float>(i)) +
                            0.001F * static_cast<float>(k) * Vector3f::Ones() + Vector3f::Constant(0.003F),
                        Vector3f::UnitZ(),
                        {1, 2, 3}});
  CloudConfig config;
  config.deviations = 1000.0;
  EXPECT_LT(cleanCloud(points, config).size(), 700U);
}

TEST(CloudOfTest, PlacesSubmapsWhereTheirKeyScansAre) {
  std::mt19937 random(4);
  common::Submap3d submap;
  submap.points = std::make_shared<const std::vector<SurfacePoint>>(wall(random));
  submap.T_key_submap = {common::quaternionFrom({0.0, 0.0, 0.3}), {0.5, 0.0, 0.2}};
  common::KeyPoses keys{1, {{{}, {1.0, 2.0, 0.5}}}};
  const auto furthest = [&](const std::vector<SurfacePoint>& cloud) {
    const common::Pose3 T_submap_map = submap.T_map_submap(keys).inverse();
    double error_m = 0.0, wrong_normal = 0.0;
    for (const SurfacePoint& point : cloud) {
      error_m = std::max(error_m, std::abs((T_submap_map * Vector3d(point.position_m.cast<double>())).x() - 1.013));
      const Vector3d normal = T_submap_map.rotation * point.normal.cast<double>();
      wrong_normal = std::max(wrong_normal, (normal + Vector3d::UnitX()).norm());
    }
    return std::max(error_m, wrong_normal);
  };
  const std::vector<SurfacePoint> before = cloudOf({submap}, keys);
  EXPECT_GT(before.size(), 5000U);
  EXPECT_LT(furthest(before), 0.02);
  keys.keys[0].T_map_key = {-3.0, 1.0, -1.0};
  EXPECT_GT(furthest(before), 1.0);
  EXPECT_LT(furthest(cloudOf({submap}, keys)), 0.02);
}

/// A grid of points at x that faces the origin, up to 1.5 m high.
void addWall(std::vector<SurfacePoint>& points, float x, float from_y, float to_y, float apart) {
  for (float y = from_y + 0.5F * apart; y < to_y; y += apart)
    for (float z = 0.5F * apart; z < 1.5F; z += apart) points.push_back({{x, y, z}, -Vector3f::UnitX(), {9, 9, 9}});
}

/// The last points of a submap are of large cubes.
common::Submap3d submapOf(const std::vector<SurfacePoint>& fine, const std::vector<SurfacePoint>& coarse) {
  std::vector<SurfacePoint> points = fine;
  points.insert(points.end(), coarse.begin(), coarse.end());
  common::Submap3d submap;
  submap.points = std::make_shared<const std::vector<SurfacePoint>>(std::move(points));
  submap.coarse = coarse.size();
  submap.T_key_submap = {common::quaternionFrom({0.0, 0.0, 0.4}), {0.03, 0.01, 0.02}};
  return submap;
}

/// Of points of submapOf(), in the submap's frame.
std::vector<SurfacePoint> cloudInSubmap(const std::vector<common::Submap3d>& submaps) {
  const common::KeyPoses keys{1, {{}}};
  std::vector<SurfacePoint> cloud = cloudOf(submaps, keys);
  const common::Pose3 T_submap_map = submaps[0].T_map_submap(keys).inverse();
  for (SurfacePoint& point : cloud)
    point.position_m = (T_submap_map * Vector3d(point.position_m.cast<double>())).cast<float>();
  return cloud;
}

float nearest_m(const std::vector<SurfacePoint>& cloud, const Vector3f& place) {
  float least_m = std::numeric_limits<float>::infinity();
  for (const SurfacePoint& point : cloud) least_m = std::min(least_m, (point.position_m - place).norm());
  return least_m;
}

TEST(CloudOfTest, AWallSeenWithNoiseStaysBesideOneSeenWell) {
  std::vector<SurfacePoint> fine, coarse;
  addWall(fine, 1.01F, -1.0F, 1.0F, 0.02F);
  addWall(coarse, 1.01F, 1.12F, 2.0F, 0.08F);  // PointGrid leaves this gap.
  const Vector3f speck(0.2F, 0.0F, 0.7F), noisy_speck(0.2F, 1.6F, 0.7F);
  fine.push_back({speck, Vector3f::Zero(), {}});
  coarse.push_back({noisy_speck, Vector3f::Zero(), {}});
  const std::vector<SurfacePoint> cloud = cloudInSubmap({submapOf(fine, coarse)});
  for (float y = -1.0F; y < 2.0F; y += 0.03F)
    for (float z = 0.0F; z < 1.5F; z += 0.03F) {
      const Vector3f place(1.01F, y, z);
      ASSERT_LT(nearest_m(cloud, place), 0.1F) << place.transpose();
    }
  EXPECT_GT(nearest_m(cloud, speck), 0.5F);
  EXPECT_GT(nearest_m(cloud, noisy_speck), 0.5F);
}

TEST(CloudOfTest, NoisyPointsAreLeftOutWhereAnotherSubmapSawTheirSurfaceWell) {
  std::vector<SurfacePoint> fine, coarse;
  addWall(fine, 1.01F, -1.0F, 1.0F, 0.02F);
  addWall(coarse, 0.95F, -1.0F, 1.0F, 0.08F);
  addWall(coarse, 0.95F, 3.0F, 4.0F, 0.08F);
  const std::vector<SurfacePoint> cloud = cloudInSubmap({submapOf(fine, {}), submapOf({}, coarse)});
  std::size_t beyond = 0;
  for (const SurfacePoint& point : cloud) {
    if (point.position_m.y() > 2.0F)
      ++beyond;
    else
      ASSERT_GT(point.position_m.x(), 1.0F) << point.position_m.transpose();
  }
  EXPECT_GT(beyond, 80U) << "of 234 in one submap, thinned in cubes across those";
}

TEST(CloudOfTest, EqualSubmapsGiveEqualBytes) {
  std::mt19937 random(5);
  const std::vector<SurfacePoint> points = wall(random, 0.01);
  const std::vector<SurfacePoint> once = cleanCloud(points), again = cleanCloud(points);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_EQ(once[i].position_m, again[i].position_m);
    ASSERT_EQ(once[i].normal, again[i].normal);
    ASSERT_EQ(once[i].rgb, again[i].rgb);
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
