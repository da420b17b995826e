// Paths by sampling: through windows with the hull, the same for the same arguments, and a reason where there is none.
#include "planning/sampling/sampling_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "common/voxel_map.hpp"
#include "grid_builder.hpp"
#include "planning/sampling/reachable_space.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector3d;
using Reason = SpacePlanFailure::Reason;

constexpr double kRoomForHull_m = 0.375, kHullHeight_m = 0.25;

/// 8 x 4 x 2.5 m in voxels of 5 cm, with walls across it that have a gap of 0.85 x 0.85 m at (y, z), if any.
struct Wall {
  double x_m, gap_y_m, gap_z_m;
};

Clearance hall(const std::vector<Wall>& walls, const std::vector<Vector3d>& blocked = {}) {
  common::VoxelMap map(0.05);
  constexpr double kHalfGap_m = 0.425;
  for (int z = 0; z < 50; ++z)
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 160; ++x) {
        const Vector3d center_m = map.centerOf({x, y, z});
        bool matter = false;
        for (const Wall& wall : walls)
          matter |= std::abs(center_m.x() - wall.x_m) < 0.06 && !(std::abs(center_m.y() - wall.gap_y_m) < kHalfGap_m &&
                                                                  std::abs(center_m.z() - wall.gap_z_m) < kHalfGap_m);
        for (const Vector3d& place_m : blocked) matter |= (center_m - place_m).norm() < 0.06;
        map.set({x, y, z}, matter ? std::int8_t{40} : std::int8_t{-40});
      }
  Clearance clearance = Clearance::ofSpace(0.05, kHullHeight_m);
  clearance.update(map.snapshot());
  return clearance;
}

const std::vector<Wall> kThreeGaps{{2.0, 1.0, 0.6}, {4.0, 3.0, 1.9}, {6.0, 1.0, 1.2}};
const Vector3d kStart(0.6, 2.0, 1.0), kGoal(7.4, 2.0, 1.0);

void expectSound(const SpacePath& path, const Clearance& clearance, const Vector3d& start, const Vector3d& goal) {
  ASSERT_GE(path.points_map_m.size(), 2U);
  EXPECT_EQ(path.points_map_m.front(), start);
  EXPECT_EQ(path.points_map_m.back(), goal);
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.points_map_m.size(); ++i) {
    const Vector3d& a = path.points_map_m[i - 1];
    const Vector3d& b = path.points_map_m[i];
    length_m += (b - a).norm();
    for (double t = 0.0; t <= 1.0; t += 0.01)
      EXPECT_GE(clearance.at_m(Vector3d(a + t * (b - a))), kRoomForHull_m - 0.075);
  }
  EXPECT_NEAR(path.length_m, length_m, 1e-9);
  EXPECT_GE(path.clearance_m, kRoomForHull_m - 0.075);
}

TEST(SamplingPlanner, FliesThroughGapsThatNoPlaneJoins) {
  const Clearance clearance = hall(kThreeGaps);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto path = planBySampling(clearance, kStart, kGoal, kRoomForHull_m, seed);
    ASSERT_TRUE(path) << path.error().text;
    expectSound(*path, clearance, kStart, kGoal);
    EXPECT_LT(path->length_m, 12.0) << seed;
  }
}

TEST(SamplingPlanner, IsStraightWhereNothingIsInTheWay) {
  const Clearance clearance = hall({});
  const auto path = planBySampling(clearance, kStart, kGoal, kRoomForHull_m);
  ASSERT_TRUE(path) << path.error().text;
  EXPECT_NEAR(path->length_m, (kGoal - kStart).norm(), 1e-6);
}

TEST(SamplingPlanner, MakesTheSamePathInTwoThreadsAtOnce) {
  const Clearance clearance = hall(kThreeGaps);
  const auto plans = [&](std::vector<SpacePath>& paths) {
    for (std::uint64_t seed = 0; seed < 10; ++seed)
      paths.push_back(*planBySampling(clearance, kStart, kGoal, kRoomForHull_m, seed));
  };
  std::vector<SpacePath> alone, one, other;
  plans(alone);
  std::thread first([&] { plans(one); }), second([&] { plans(other); });
  first.join();
  second.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].points_map_m, one[i].points_map_m) << i;
    EXPECT_EQ(alone[i].points_map_m, other[i].points_map_m) << i;
    EXPECT_EQ(alone[i].states, one[i].states) << i;
  }
  EXPECT_NE(alone[0].points_map_m, alone[1].points_map_m);
}

TEST(SamplingPlanner, PlansInThePlane) {
  common::OccupancyGrid grid = test::room(120, 100);
  test::fill(grid, {{60, 0}, {63, 80}}, test::kWallCell);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m());
  clearance.update(grid.snapshot());
  const Vector3d start(1.0, 1.0, 1.3), goal(5.0, 1.0, 1.3);
  const auto path = planBySampling(clearance, start, goal, kRoomForHull_m);
  ASSERT_TRUE(path) << path.error().text;
  expectSound(*path, clearance, start, goal);
  for (const Vector3d& point_m : path->points_map_m) EXPECT_EQ(point_m.z(), 1.3);
}

TEST(SamplingPlanner, RefusesWithTheReasonAndTheNearestPlace) {
  const Clearance clearance = hall({}, {{3.0, 2.0, 1.0}});
  const auto reasonOf = [&](const Vector3d& start, const Vector3d& goal) {
    const auto path = planBySampling(clearance, start, goal, kRoomForHull_m);
    return path ? std::nullopt : std::optional(path.error().reason);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reasonOf({nan, 2, 1}, kGoal), Reason::kOutsideMap);
  EXPECT_EQ(reasonOf(kStart, {7, std::numeric_limits<double>::infinity(), 1}), Reason::kOutsideMap);
  EXPECT_EQ(reasonOf(kStart, {70, 2, 1}), Reason::kOutsideMap);
  EXPECT_EQ(reasonOf(kStart, {1e300, 2, 1}), Reason::kOutsideMap);
  EXPECT_EQ(reasonOf({3.0, 2.0, 1.0}, kGoal), Reason::kStartBlocked);
  EXPECT_EQ(reasonOf(kStart, {3.0, 2.0, 1.0}), Reason::kGoalBlocked);
  const auto blocked = planBySampling(clearance, kStart, {3.1, 2.0, 1.0}, kRoomForHull_m);
  ASSERT_TRUE(blocked.error().nearest_map_m);
  EXPECT_GE(clearance.at_m(*blocked.error().nearest_map_m), kRoomForHull_m);
  EXPECT_LT((*blocked.error().nearest_map_m - Vector3d(3.1, 2.0, 1.0)).norm(), 0.4);
}

TEST(SamplingPlanner, TellsAGoalThatIsWalledIn) {
  const Clearance clearance = hall({{4.0, -9.0, -9.0}});
  const auto path = planBySampling(clearance, kStart, kGoal, kRoomForHull_m);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().reason, Reason::kUnreachable);
  ASSERT_TRUE(path.error().nearest_map_m);
  const Vector3d nearest_m = *path.error().nearest_map_m;
  EXPECT_NEAR(nearest_m.x(), 4.0 - 0.05 - kRoomForHull_m, 0.06);
  EXPECT_TRUE(planBySampling(clearance, kStart, nearest_m, kRoomForHull_m));
}

TEST(SamplingPlanner, FindsAlongTheCellsWhatSamplesDoNot) {
  const Clearance clearance = hall(kThreeGaps);
  SamplingEffort none;
  none.iterations = 1;
  const auto path = planBySampling(clearance, kStart, kGoal, kRoomForHull_m, 0, none);
  ASSERT_TRUE(path) << path.error().text;
  expectSound(*path, clearance, kStart, kGoal);
}

TEST(ReachableSpace, HasAPathOfNeighboursThatAreFree) {
  const Clearance clearance = hall(kThreeGaps);
  const ReachableSpace reachable(clearance, kStart, kRoomForHull_m);
  ASSERT_TRUE(reachable.reaches(kGoal));
  const std::vector<Vector3d> path = reachable.pathTo(kGoal);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_GE(clearance.at_m(path[i]), kRoomForHull_m);
    EXPECT_NEAR((path[i] - path[i == 0 ? 0 : i - 1]).norm(), i == 0 ? 0.0 : 0.05, 1e-9);
  }
  EXPECT_LT((path.back() - kGoal).norm(), 0.05);
  EXPECT_FALSE(reachable.reaches({2.0, 3.0, 0.6}));
  EXPECT_FALSE(reachable.reaches({-1.0, 3.0, 0.6}));
  EXPECT_EQ(ReachableSpace(clearance, {2.0, 3.0, 0.6}, kRoomForHull_m).nearestTo(kGoal), std::nullopt);
}

}  // namespace
}  // namespace swiftlet::planning
