#include "simulation/ray_caster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "fixtures.hpp"
#include "simulation/hull_geometry.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::simulation {
namespace {

using common::RandomStream;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d randomDirection(RandomStream& random) {
  return Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
}

/// A clutter of random triangles, in several shapes.
WorldModel clutter(std::uint64_t seed, int triangles) {
  RandomStream random(seed, "clutter");
  WorldModel world;
  for (int s = 0; s < 4; ++s) {
    Shape shape;
    shape.model = "shape " + std::to_string(s);
    for (int i = 0; i < triangles / 4; ++i) {
      const Vector3d centre(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 2));
      const auto first = static_cast<std::uint32_t>(shape.vertices_world_m.size());
      for (int k = 0; k < 3; ++k)
        shape.vertices_world_m.push_back((centre + 0.8 * random.uniform() * randomDirection(random)).cast<float>());
      shape.triangles.push_back({first, first + 1, first + 2});
    }
    world.shapes.push_back(shape);
  }
  return world;
}

/// A slow and simple ray caster: it tests every triangle, in double precision.
double bruteForce(const WorldModel& world, const Vector3d& origin, const Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Shape& shape : world.shapes) {
    for (const auto& triangle : shape.triangles) {
      const Vector3d a = shape.vertices_world_m[triangle[0]].cast<double>();
      Eigen::Matrix3d m;
      m << shape.vertices_world_m[triangle[1]].cast<double>() - a,
          shape.vertices_world_m[triangle[2]].cast<double>() - a, -direction;
      const Vector3d uvt = m.fullPivLu().solve(origin - a);
      if (uvt.x() >= 0 && uvt.y() >= 0 && uvt.x() + uvt.y() <= 1 && uvt.z() > 0) nearest = std::min(nearest, uvt.z());
    }
  }
  return nearest;
}

/// A room of 4 m by 4 m by 3 m with a mirror on the wall at x = 4 m shows itself as a room behind that wall would.
TEST(RayCaster, SeesAMirrorAsTheRoomBehindIt) {
  WorldModel with_mirror, behind;
  const auto add = [](WorldModel& world, const Vector3d& low, const Vector3d& high, bool mirror = false) {
    world.shapes.push_back(boxShape("wall", low, high));
    world.shapes.back().mirror = mirror;
  };
  for (WorldModel* world : {&with_mirror, &behind}) {
    add(*world, {-0.1, -2, 0}, {0, 2, 3});
    add(*world, {0, -2.1, 0}, {4, -2, 3});
    add(*world, {0, 2, 0}, {4, 2.1, 3});
    add(*world, {1, 0.5, 0}, {1.5, 1, 1.2});
  }
  add(with_mirror, {4, -2, 0}, {4.02, 2, 3}, true);
  add(behind, {8, -2, 0}, {8.1, 2, 3});
  add(behind, {4, -2.1, 0}, {8, -2, 3});
  add(behind, {4, 2, 0}, {8, 2.1, 3});
  add(behind, {6.5, 0.5, 0}, {7, 1, 1.2});
  const RayCaster mirror(with_mirror), room(behind);
  RandomStream random(3, "rays");
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) {
    const Vector3d from(random.uniform(2, 3.9), random.uniform(-1.5, 1.5), random.uniform(0.5, 2));
    const Vector3d to(random.uniform(6, 8), random.uniform(-1.9, 1.9), random.uniform(0.1, 2.5));
    rays.push_back({from.cast<float>(), (to - from).normalized().cast<float>()});
  }
  std::vector<Hit> hits(rays.size());
  std::vector<float> distances_m(rays.size());
  mirror.castAll(rays, 30.0, {}, hits);
  mirror.castAll(rays, 30.0, {}, distances_m);
  int boxes = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vector3d from = rays[i].origin_world_m.cast<double>(), direction = rays[i].direction_world.cast<double>();
    const Hit seen = mirror.cast(from, direction, 30.0), wanted = room.cast(from, direction, 30.0);
    ASSERT_EQ(static_cast<bool>(seen), static_cast<bool>(wanted)) << i;
    if (!wanted) continue;
    EXPECT_NEAR(seen.distance_m, wanted.distance_m, 5e-3) << i;
    EXPECT_NEAR(seen.normal_world.dot(wanted.normal_world), 1.0F, 1e-4F) << i;
    EXPECT_EQ(hits[i].distance_m, seen.distance_m);
    EXPECT_EQ(distances_m[i], static_cast<float>(seen.distance_m));
    boxes += seen.shape == 3 ? 1 : 0;
  }
  EXPECT_GT(boxes, 20) << "the box before the mirror is seen in it";
  EXPECT_FALSE(mirror.cast({2, 0, 1}, Vector3d::UnitX(), 2.5)) << "what it shows is farther than that";
  EXPECT_LT(mirror.nearest({3.8, 0, 1}, 1.0).distance_m, 0.201) << "and it is touched where it is";
}

TEST(RayCaster, EndsBetweenTwoMirrors) {
  WorldModel world;
  for (const double x : {0.0, 1.0}) {
    world.shapes.push_back(boxShape("mirror", {x, -2, 0}, {x + 0.02, 2, 3}));
    world.shapes.back().mirror = true;
  }
  EXPECT_FALSE(RayCaster(world).cast({0.5, 0, 1}, Vector3d::UnitX(), 1e4));
}

TEST(RayCaster, GivesTheDistanceToTheWallsOfARoom) {
  const RayCaster rays(boxRoom());
  const Hit east = rays.cast({1, 2, 1}, {1, 0, 0}, 30);
  EXPECT_NEAR(east.distance_m, 4.0, 1e-5);
  EXPECT_EQ(east.shape, 2);
  EXPECT_NEAR(east.normal_world.x(), -1.0, 1e-6);
  EXPECT_NEAR(rays.cast({1, 2, 1}, {0, 0, -1}, 30).distance_m, 1.0, 1e-5);
  EXPECT_NEAR(rays.cast({1, 2, 1}, {0, 0, 1}, 30).distance_m, 2.0, 1e-5);
  EXPECT_FALSE(rays.cast({1, 2, 1}, {1, 0, 0}, 3.9));
}

TEST(RayCaster, EqualsTestingEveryTriangle) {
  const WorldModel world = clutter(3, 1200);
  const RayCaster rays(world);
  RandomStream random(1, "rays");
  std::vector<Ray> batch;
  std::vector<double> expected;
  for (int i = 0; i < 1001; ++i) {
    const Vector3d origin(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 2));
    batch.push_back({origin.cast<float>(), randomDirection(random).cast<float>()});
    expected.push_back(
        bruteForce(world, batch.back().origin_world_m.cast<double>(), batch.back().direction_world.cast<double>()));
  }
  std::vector<float> distances(batch.size());
  std::vector<Hit> hits(batch.size());
  rays.castAll(batch, 100, {}, distances);
  rays.castAll(batch, 100, {}, hits);
  int met = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Hit one = rays.cast(batch[i].origin_world_m.cast<double>(), batch[i].direction_world.cast<double>(), 100);
    if (!std::isfinite(expected[i])) {
      EXPECT_FALSE(one);
      EXPECT_FALSE(std::isfinite(distances[i]));
      continue;
    }
    ++met;
    EXPECT_NEAR(one.distance_m, expected[i], 1e-4);
    EXPECT_NEAR(distances[i], expected[i], 1e-4);
    EXPECT_NEAR(hits[i].distance_m, expected[i], 1e-4);
    EXPECT_EQ(hits[i].shape, one.shape);
  }
  EXPECT_GT(met, 300);
}

TEST(RayCaster, HitsAPersonFromTheSideAndFromAbove) {
  const RayCaster rays(boxRoom());
  const std::vector<Actor> people{{{2.0, 0.0}, 0.25, 0.0, 1.75}};
  const Hit side = rays.cast({0, 0, 1}, {1, 0, 0}, 30, people);
  EXPECT_NEAR(side.distance_m, 1.75, 1e-9);
  EXPECT_EQ(side.shape, 6);
  EXPECT_NEAR(rays.cast({2.1, 0, 2.5}, {0, 0, -1}, 30, people).distance_m, 0.75, 1e-9);
  EXPECT_NEAR(rays.cast({0, 0, 2}, {1, 0, 0}, 30, people).distance_m, 5.0, 1e-5) << "passes over the head";
  EXPECT_NEAR(rays.cast({0, 0.3, 1}, {1, 0, 0}, 30, people).distance_m, 5.0, 1e-5) << "passes by";
  std::vector<Ray> row{{{0, 0, 1}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}}};
  std::vector<float> distances(2);
  rays.castAll(row, 30, people, distances);
  EXPECT_NEAR(distances[0], 1.75, 1e-5);
  EXPECT_NEAR(distances[1], 4.0, 1e-5);
}

TEST(RayCaster, ClearanceIsHorizontalWithinTheHullsHeight) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("table", {1.0, -0.5, 0.70}, {2.0, 0.5, 0.75}));
  const RayCaster rays(world);
  const Hull hull{0.275, 0.125};
  const auto at = [&](double x, double y, double z) { return rays.sweep(hull, {x, y, z}, {x, y, z}, 1.0); };
  EXPECT_NEAR(at(4.0, 0, 1.5).distance_m, 0.725, 1e-6);
  EXPECT_EQ(at(4.0, 0, 1.5).shape, 2);
  EXPECT_EQ(at(0, 0, 1.5).shape, Hit::kNothing);
  EXPECT_EQ(at(0, 0, 1.5).distance_m, 1.0);
  EXPECT_EQ(at(1.5, 0, 0.90).shape, Hit::kNothing) << "2.5 cm above the table";
  EXPECT_EQ(at(1.5, 0, 0.86).distance_m, 0.0) << "in the table top";
  EXPECT_EQ(at(1.5, 0, 0.86).shape, 6);
  EXPECT_NEAR(at(0.5, 0, 0.75).distance_m, 0.225, 1e-6);
}

TEST(RayCaster, SweepEqualsTheSmallestOfManySmallSteps) {
  const WorldModel world = clutter(5, 400);
  const RayCaster rays(world);
  const Hull hull{0.1, 0.05};
  RandomStream random(2, "sweeps");
  int touched = 0, open = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = random.uniform(0.2, 1.8);
    const Vector3d from(random.uniform(-5, 5), random.uniform(-5, 5), z);
    const Vector3d to = from + Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const double swept = rays.sweep(hull, from, to, 0.5).distance_m;
    double stepped = 0.5;
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const Vector3d at = from + static_cast<double>(k) / kSteps * (to - from);
      stepped = std::min(stepped, rays.sweep(hull, at, at, 0.5).distance_m);
    }
    EXPECT_LE(swept, stepped + 1e-9);
    EXPECT_NEAR(swept, stepped, (to - from).norm() / kSteps + 1e-6);
    touched += swept == 0.0 ? 1 : 0;
    open += swept > 0.0 ? 1 : 0;
  }
  EXPECT_GT(touched, 20);
  EXPECT_GT(open, 20);
}

TEST(RayCaster, ClearanceEqualsSamplingTheTriangles) {
  RandomStream random(4, "slices");
  for (int i = 0; i < 300; ++i) {
    std::array<Vector3d, 3> triangle;
    for (Vector3d& corner : triangle) corner = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Slice slice(triangle, -0.3, 0.3);
    const Vector2d point(random.uniform(-1, 1), random.uniform(-1, 1));
    double sampled = std::numeric_limits<double>::infinity();
    constexpr int kSamples = 300;
    for (int a = 0; a <= kSamples; ++a) {
      for (int b = 0; a + b <= kSamples; ++b) {
        const Vector3d at = triangle[0] + static_cast<double>(a) / kSamples * (triangle[1] - triangle[0]) +
                            static_cast<double>(b) / kSamples * (triangle[2] - triangle[0]);
        if (std::abs(at.z()) <= 0.3) sampled = std::min(sampled, (at.head<2>() - point).norm());
      }
    }
    if (slice.empty()) {
      EXPECT_FALSE(std::isfinite(sampled));
    } else if (std::isfinite(sampled)) {
      const double exact = slice.nearestTo({point, point}).distance_m;
      EXPECT_LE(exact, sampled + 1e-9);
      EXPECT_NEAR(exact, sampled, 0.02);
    }
  }
}

TEST(TruthMap, FloodsTheRoomButNotThroughANarrowGap) {
  WorldModel world = boxRoom();
  // A wall of paper at x = 1 with a gap of 0.5 m, and later one of 0.7 m.
  world.shapes.push_back(boxShape("paper south", {1.0, -4.0, 0.0}, {1.001, -0.25, 3.0}));
  world.shapes.push_back(boxShape("paper north", {1.0, 0.25, 0.0}, {1.001, 4.0, 3.0}));
  FreeSpaceQuery query;
  const FreeSpace narrow = freeSpace(RayCaster(world), query);
  // Centres keep the hull's radius from the walls: 6 m x 8 m of floor.
  EXPECT_NEAR(narrow.reachable_area_m2, (6.0 - 0.55) * (8.0 - 0.55), 1.0);
  EXPECT_EQ(narrow.reachable.at(narrow.reachable.cellAt(3.0, 0.0)), 0);
  EXPECT_EQ(narrow.covered.at(narrow.covered.cellAt(0.9, 0.0)), 1) << "the hull reaches to the gap";

  world.moveModel("paper north", {0.0, 0.2});
  const FreeSpace wide = freeSpace(RayCaster(world), query);
  EXPECT_EQ(wide.reachable.at(wide.reachable.cellAt(3.0, 0.0)), 1);
  EXPECT_NEAR(distanceToSurface2d(RayCaster(world), {0.0, -1.0}, 1.0, 2.0), 1.0, 1e-5);
}

// Compared with the nearest of many points spread over every triangle.
TEST(RayCaster, TheNearestSurfaceIsAsNearAsTheNearestOfItsPoints) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("post", {1.0, 1.0, 0.0}, {1.3, 1.2, 2.0}));
  const RayCaster rays(world);
  std::vector<Eigen::Vector3d> points;
  constexpr int kSteps = 60;
  for (const Shape& shape : world.shapes)
    for (const auto& triangle : shape.triangles)
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
          const Eigen::Vector3f a = shape.vertices_world_m[triangle[0]], b = shape.vertices_world_m[triangle[1]];
          const Eigen::Vector3f c = shape.vertices_world_m[triangle[2]];
          const float s = static_cast<float>(i) / kSteps, t = static_cast<float>(j) / kSteps;
          points.emplace_back((a + s * (b - a) + t * (c - a)).cast<double>());
        }
  common::RandomStream random(1, "nearest");
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d from(random.uniform(-6, 6), random.uniform(-5, 5), random.uniform(-1, 4));
    double least_m = 100.0;
    for (const Eigen::Vector3d& point : points) least_m = std::min(least_m, (point - from).norm());
    const NearestSurface nearest = rays.nearest(from, 10.0);
    ASSERT_NE(nearest.shape, Hit::kNothing);
    EXPECT_LE(nearest.distance_m, least_m + 1e-5);
    EXPECT_GT(nearest.distance_m, least_m - 0.12) << "points are 0.18 m apart";
    EXPECT_NEAR((nearest.point_world_m - from).norm(), nearest.distance_m, 1e-9);
  }
  EXPECT_EQ(rays.nearest({0, 0, 1.5}, 0.5).shape, Hit::kNothing);
  EXPECT_EQ(rays.nearest({0, 0, 1.5}, 0.5).distance_m, 0.5);
}

}  // namespace
}  // namespace swiftlet::simulation
